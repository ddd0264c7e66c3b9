#!/usr/bin/python3
"""Lines typed into one shell, and the list of lines that scripts/firstHour types."""

import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from pageText import ROOT, typedLines
from shellTyping import typeLines


class Typing(unittest.TestCase):
    def typed(self, *lines):
        with tempfile.TemporaryFile("w+") as log:
            done = list(typeLines([], "/tmp", [line if isinstance(line, dict) else {"command": line} for line in lines], log))
            log.seek(0)
            return [ok for _, _, ok in done], [seconds for _, seconds, _ in done], log.read()

    def testOneShellForAll(self):
        oks, _, said = self.typed("cd /usr", "word='a b'", "echo \"$word in $PWD\"")
        self.assertEqual(oks, [True] * 3)
        self.assertIn("a b in /usr\n", said)

    def testAFailureIsSeenAndTheNextLineTyped(self):
        self.assertEqual(self.typed("false", "true", "noSuchProgram")[0], [False, True, False])

    def testAfterTheShellsEndNothingIsDone(self):
        self.assertEqual(self.typed("true", "exit 0", "true")[0], [True, False, False])

    def testTimes(self):
        _, seconds, _ = self.typed({"command": "true", "before": "sleep .3"}, "sleep .3")
        self.assertLess(seconds[0], 0.2)
        self.assertGreater(seconds[1], 0.3)

    def testFolderAndAnswer(self):
        oks, _, said = self.typed({"command": "pwd", "in": "/usr"}, "pwd", {"command": "read word; echo it says $word", "answer": "y"})
        self.assertEqual(oks, [True] * 3)
        self.assertIn("/usr\n>>> pwd\n/tmp\n", said)
        self.assertIn("it says y", said)

    def testWhatIsLeftOutIsNotTyped(self):
        self.assertNotIn("never", self.typed({"command": "echo never", "left": "takes long"}, "true")[2])

    def testNoRootNoLine(self):
        with tempfile.TemporaryFile("w+") as log:
            self.assertEqual([ok for _, _, ok in typeLines(["false"], "/tmp", [{"command": "true"}], log)], [False])


class FirstHour(unittest.TestCase):
    def testTypesTheLinesOfThePages(self):
        """Exits with an error where the table names a line that its page has lost."""
        said = subprocess.run([ROOT / "scripts/firstHour", "--list"], check=True, capture_output=True, text=True).stdout.splitlines()
        for command, _ in typedLines((ROOT / "cases/tutorials/hopperQuick/README.md").read_text()):
            self.assertIn(command, said)
        self.assertIn("mine/Allrun", said)

    def testQuickSaysWhatItLeavesOut(self):
        said = subprocess.run([ROOT / "scripts/firstHour", "--list", "--quick"], check=True, capture_output=True, text=True).stdout
        self.assertRegex(said, "# scripts/test: left out, ")


if __name__ == "__main__":
    unittest.main()
