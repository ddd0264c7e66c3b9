#!/usr/bin/python3
"""Lines typed into one shell, and the list of lines that scripts/firstHour types."""

import subprocess
import tempfile
import unittest
from typing import Any

from clepsydra.environment import REPOSITORY as ROOT
from developers.page_text import typed_lines
from developers.shell_typing import type_lines


class Typing(unittest.TestCase):
    def typed(self, *lines: Any) -> tuple[list[Any], list[Any], Any]:
        with tempfile.TemporaryFile("w+") as log:
            done = list(
                type_lines([], "/tmp", [line if isinstance(line, dict) else {"command": line} for line in lines], log)
            )
            log.seek(0)
            return [ok for _, _, ok in done], [seconds for _, seconds, _ in done], log.read()

    def test_one_shell_for_all(self) -> None:
        oks, _, said = self.typed("cd /usr", "word='a b'", 'echo "$word in $PWD"')
        self.assertEqual(oks, [True] * 3)
        self.assertIn("a b in /usr\n", said)

    def test_a_failure_is_seen_and_the_next_line_typed(self) -> None:
        self.assertEqual(self.typed("false", "true", "noSuchProgram")[0], [False, True, False])

    def test_after_the_shells_end_nothing_is_done(self) -> None:
        self.assertEqual(self.typed("true", "exit 0", "true")[0], [True, False, False])

    def test_times(self) -> None:
        _, seconds, _ = self.typed({"command": "true", "before": "sleep .3"}, "sleep .3")
        self.assertLess(seconds[0], 0.2)
        self.assertGreater(seconds[1], 0.3)

    def test_folder_and_answer(self) -> None:
        oks, _, said = self.typed(
            {"command": "pwd", "in": "/usr"}, "pwd", {"command": "read word; echo it says $word", "answer": "y"}
        )
        self.assertEqual(oks, [True] * 3)
        self.assertIn("/usr\n>>> pwd\n/tmp\n", said)
        self.assertIn("it says y", said)

    def test_what_is_left_out_is_not_typed(self) -> None:
        self.assertNotIn("never", self.typed({"command": "echo never", "left": "takes long"}, "true")[2])

    def test_no_root_no_line(self) -> None:
        with tempfile.TemporaryFile("w+") as log:
            self.assertEqual([ok for _, _, ok in type_lines(["false"], "/tmp", [{"command": "true"}], log)], [False])


class FirstHour(unittest.TestCase):
    def test_types_the_lines_of_the_pages(self) -> None:
        """Exits with an error where the table names a line that its page has lost."""
        said = subprocess.run(
            [ROOT / "scripts/firstHour", "--list"], check=True, capture_output=True, text=True
        ).stdout.splitlines()
        for command, _ in typed_lines((ROOT / "cases/tutorials/hopperQuick/README.md").read_text()):
            self.assertIn(command, said)
        self.assertIn("mine/Allrun", said)

    def test_quick_says_what_it_leaves_out(self) -> None:
        said = subprocess.run(
            [ROOT / "scripts/firstHour", "--list", "--quick"], check=True, capture_output=True, text=True
        ).stdout
        self.assertRegex(said, "# scripts/test: left out, ")


if __name__ == "__main__":
    unittest.main()
