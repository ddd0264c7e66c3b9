"""No word of our own where the field has another: CHANGELOG.md says what each was replaced by.

A repository in which one file still speaks of beads, ledgers or rigs fails, with file and line. Names that stand in
data of others (bead3_trial_1.txt), in sealed records and in the table of old names are the only exceptions. """

import re
import subprocess
import unittest
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

OLD = set(
    "bead beads ledger ledgers booked turnover visitor visitors misfit misfits foil foils rig rigs anew lone mended "
    "told campaign campaigns poured".split()
)
OLD_PHRASES = re.compile(r"\bstand-?ins?\b", re.IGNORECASE)

# What must keep its bytes or names things of others: records that are sealed or hashed, inputs that a fuzzer found,
# the licence;
# what exists to name the old words.
EXEMPT = re.compile(
    r"CHANGELOG\.md|LICENSE|cases/paper/README\.md|cases/studies/blindHopper/(oldNames\.py|old_names\.py|results/)"
    r"|tests/fuzz/found/|coupling/tokens/renamed\.cpp|tests/program/badInput\.cpp|tests/scripts/word_tests\.py"
    r"|scripts/clepsydra/old_names\.py|tests/scripts/parameter_tests\.py|identification/runner/seeds\.cpp"
)
# Names of the files, columns and runs of measurements, and the material of the paper.
OF_DATA = re.compile(
    r"beadfall_glycerol|glycerine_beads_tall|nylon_beads_water|(?:glycerol|water)bead\w*"
    r"|\bbead_?[0-9*][\w.*]*|[Gg]lass[ -]beads?"
)


def words_of(line: str) -> Iterator[str]:
    """The words of a line, those that a name in camelCase or snake_case is made of, too."""
    for word in re.findall(r"[A-Za-z]+", line):
        yield from (part.lower() for part in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", word))


def findings(name: str, text: str) -> list[str]:
    return [
        f"{name}:{number}: {sorted(found)}"
        for number, line in enumerate(text.splitlines(), 1)
        if (found := OLD.intersection(words_of(OF_DATA.sub("", line))) | set(OLD_PHRASES.findall(line)))
    ]


class Words(unittest.TestCase):
    def test_a_word_is_found_in_whatever_name(self) -> None:
        """Otherwise the next test finds nothing anywhere."""
        for line in (
            "beadDiameter",
            "n_beads",
            "BEADS",
            "// a lone sphere",
            "theLedger",
            "StandIns",
            "the case is told",
        ):
            self.assertEqual(len(findings("file", line)), 1, line)
        for line in ("rigid", "bead3_trial_1.txt", "alone", "glass beads of 2 mm", "standing"):
            self.assertEqual(findings("file", line), [], line)

    def test_no_old_word_is_left(self) -> None:
        tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        found = []
        for name in filter(None, tracked.split("\0")):
            if EXEMPT.match(name):
                continue
            found += findings(name, name)
            try:
                found += findings(name, (ROOT / name).read_text())
            except (UnicodeDecodeError, IsADirectoryError, FileNotFoundError):
                pass  # a picture, an archive, a link to a folder
        self.assertEqual(found, [], "\n".join(["", *found[:40]]))


if __name__ == "__main__":
    unittest.main()
