"""A LIGGGHTS script of CFDEMcoupling, rewritten for pimpleDemFoam, which runs LIGGGHTS itself."""

import re
from typing import Any, Iterator

from clepsydra import seeds
from clepsydra.cfdem_cases.report import Report

COUPLING_FIXES = (
    "couple/cfd",
    "couple/cfd/force",
    "couple/cfd/force/implicit",
    "couple/cfd/force/accumulator",
    "couple/cfd/force/implicit/accumulated",
)
MADE_BY_COUPLING = ("dragforce", "couple_cfd", "hdtorque", "Ksl", "uf", "expForces")  # fixes that those make
LOGS = ("log", "thermo_log", "echo")
RESTARTS = ("write_restart", "restart")
REFUSED = ("jump", "label", "next", "rerun", "minimize")
MAKES_PARTICLES = ("insert/pack", "insert/rate/region", "insert/stream", "read_restart", "read_data", "create_atoms")


def output_folders(text: str) -> Iterator[str]:
    """Folders that the lines of a script write into: LIGGGHTS does not make them."""
    for line in text.splitlines():
        words = line.split("#")[0].split()
        file = (
            words[5:6]
            if words[:1] == ["dump"]
            else (
                words[1:2]
                if words[:1] and words[0] in ("write_restart", "restart", "log", "thermo_log", "write_data")
                else words[words.index("file") + 1 :][:1]
                if words[:1] == ["fix"] and "file" in words
                else []
            )
        )
        if file and "/" in file[0]:
            yield file[0].rsplit("/", 1)[0]


def with_seeds(text: str, where: str, report: Report) -> str:
    """A script with seeds that LIGGGHTS 3.8 takes: primes above 10000, no two alike."""
    taken = set()

    def replaced(line: re.Match[str]) -> str:
        seed = int(line["seed"])
        good = next(number for number in seeds.seeds_from(seed) if number not in taken)
        taken.add(good)
        if good == seed:
            return line[0]
        report.change(
            where,
            f"{' '.join(line['before'].split()[:2])}: seed {seed}",
            f"is {good}: LIGGGHTS 3.8 takes different primes above 10000; so the particles lie at other places",
        )
        return line["before"] + str(good)

    return re.sub(
        r"^(?P<before>[ \t]*fix[^#\n]*?(?:particletemplate/\w+|particledistribution/\w+|\bseed)[ \t]+)(?P<seed>\d+)",
        replaced,
        text,
        flags=re.MULTILINE,
    )


class DemScript:
    """lines: the new script. Beside it what was learnt of the old one."""

    def __init__(self, text: str, where: str, report: Report) -> None:
        self.where, self.report = where, report
        self.time_step: float | None = None
        self.gravity: list[float] | None = None
        self.couple_every: int | None = None
        self.restart: str | None = None
        self.gone = {f"f_{name}" for name in MADE_BY_COUPLING}
        self.variables: dict[Any, Any] = {}
        self.lines = []
        makers = re.findall(rf"^\s*(?!#).*?\b({'|'.join(MAKES_PARTICLES)})\b.*$", text, re.MULTILINE)
        self.is_one_particle = makers == ["create_atoms"] and bool(
            re.search(r"^\s*create_atoms\s+\S+\s+single\b", text, re.MULTILINE)
        )
        map_array = False
        for line in self.joined(with_seeds(text, where, report)):
            words = line.split("#")[0].split()
            if words[:1] == ["atom_modify"] and "map" in words:
                map_array = True
            kept = self.translated(words, line) if words else line
            if kept is not None:
                self.lines.append(kept)
        if not map_array:
            self.lines.insert(0, "atom_modify     map array")
            report.change(where, "atom_modify map array", "added: the coupling finds particles by their id")
        for name, value in (("timestep", self.time_step), ("fix ... gravity", self.gravity)):
            if value is None:
                report.error(where, name, "is missing")

    def text(self) -> str:
        return "\n".join(self.lines) + "\n"

    def joined(self, text: str) -> Iterator[str]:
        """Lines, those that end with & put together."""
        whole = ""
        for line in text.splitlines():
            if line.rstrip().endswith("&"):
                whole += line.rstrip()[:-1]
            else:
                yield (whole + line).replace("../DEM/", "DEM/")
                whole = ""

    def translated(self, words: list[str], line: str) -> Any:
        """The line as it goes into the new script; None where it is left out."""
        command = words[0]
        if command == "fix" and len(words) > 3 and words[3].startswith("couple/cfd"):
            return self.coupling_fix(words)
        if command == "processors":
            return self.left_out(line, "both engines share out among the ranks of mpirun themselves")
        if command in LOGS:
            return self.left_out(line, "LIGGGHTS writes log.liggghts")
        if command in RESTARTS:
            return self.left_out(
                line, "checkpoints hold the particles; DEM/writeRestart of couplingProperties for a file at the end"
            )
        if command == "run":
            return self.run(words, line)
        if command in REFUSED:
            self.report.error(self.where, line.strip(), f"'{command}' has no counterpart")
            return None
        if command == "coarsegraining":
            self.report.error(
                self.where,
                line.strip(),
                (
                    "LIGGGHTS 3.8 has no such command; allowed: a script with the diameters of the parcels, "
                    "and the ratio as coarseGraining in constant/couplingProperties"
                ),
            )
            return None
        if command == "newton" and words[1:] != ["off"]:
            self.report.change(
                self.where, line.strip(), "newton off: here each rank evaluates all contacts of its particles"
            )
            return "newton          off"
        if command == "timestep":
            self.time_step = self.number(words[1], line)
        if command == "variable" and words[2:3] == ["equal"]:
            self.variables[words[1]] = " ".join(words[3:])
        if command == "read_restart":
            self.restart = words[1]
        if command == "fix" and words[3] == "gravity":
            self.take_gravity(words, line)
        return self.without_gone(words, line)

    def coupling_fix(self, words: list[str]) -> Any:
        line = " ".join(words)
        if words[3] not in COUPLING_FIXES:
            self.report.error(self.where, line, f"'{words[3]}' has no counterpart; known: {', '.join(COUPLING_FIXES)}")
            return None
        self.gone.add(f"f_{words[1]}")
        if "couple_every" in words:
            self.couple_every = int(self.number(words[words.index("couple_every") + 1], line))
        return self.left_out(line, "pimpleDemFoam couples without a fix of the script")

    def run(self, words: list[str], line: str) -> Any:
        steps = self.number(words[1], line)
        if steps > 1:
            self.report.error(
                self.where,
                line.strip(),
                (
                    "runs particles alone before the coupling; do that in a script of its own, "
                    "whose restart this one reads"
                ),
            )
        return self.left_out(line, "the coupling itself runs LIGGGHTS, one coupling step at a time")

    def take_gravity(self, words: list[str], line: str) -> None:
        try:
            size, at = self.number(words[4], line), words.index("vector")
            direction = [self.number(word, line) for word in words[at + 1 : at + 4]]
        except (ValueError, IndexError):
            self.report.error(self.where, line.strip(), "allowed: gravity SIZE vector X Y Z")
            return
        length = sum(part * part for part in direction) ** 0.5
        self.gravity = [size * part / length for part in direction]

    def without_gone(self, words: list[str], line: str) -> str:
        """What refers to a fix of the coupling goes with it: columns one by one, other commands as a whole."""
        gone = [word for word in words if self.refers_to_gone(word)]
        if not gone:
            return line
        if words[0] in ("thermo_style", "dump"):
            self.report.left_out(
                self.where, f"{words[0]} {' '.join(gone)}", "columns of the coupling's fixes, which are not there"
            )
            return " ".join(word for word in words if word not in gone)
        if words[0] in ("compute", "variable"):
            self.gone.add(("c_" if words[0] == "compute" else "v_") + words[1])
        return self.left_out(line, f"refers to {' '.join(gone)} of the coupling's fixes, which are not there")

    def refers_to_gone(self, word: str) -> bool:
        return any(
            re.search(rf"\b{re.escape(name)}\b", word) or f"${{{name[2:]}}}" in word and name.startswith("v_")
            for name in self.gone
        )

    def left_out(self, line: str, why: str) -> Any:
        self.report.left_out(self.where, " ".join(line.split()), why)
        return None

    def number(self, word: str, line: str) -> float:
        variable = re.fullmatch(r"\$\{(\w+)\}", word)
        try:
            return float(self.variables.get(variable[1], word) if variable else word)
        except ValueError:
            self.report.error(self.where, line.strip(), f"'{word}' is not a number, nor a variable that equals one")
            return 1.0
