"""scripts/parameterFile.py and scripts/arithmetic.py: what is read, what is refused, what is never run."""

import subprocess
import sys
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(REPOSITORY / "scripts"))
import arithmetic
import parameterFile
from parameterFile import ParameterError, parametersIn, withParameters


class Reading(unittest.TestCase):
    def testWhatOpenFoamAllows(self):
        """Comments, references, words, vectors, tables, strings and #eval, as the cases of this repository have them."""
        text = """FoamFile { version 2.0; }
        /* a comment; over
           lines */
        a 2e-3;  // b 7;
        b $a; c ${a}; d #eval{ 3*$a };
        law DiFeliceDrag; forces gradPForce viscForce; U constant (0 0 -1); T table ((0 (0 0 1)) (1 (0 0 2)));
        script "DEM/in.x // no; comment"; _underscore -.5;"""
        self.assertEqual(parametersIn(text), {
            "a": 2e-3, "b": 2e-3, "c": 2e-3, "d": 6e-3, "law": "DiFeliceDrag", "forces": "gradPForce viscForce",
            "U": "constant (0 0 -1)", "T": "table ((0 (0 0 1)) (1 (0 0 2)))", "script": '"DEM/in.x // no; comment"',
            "_underscore": -0.5})

    def testEveryFileOfTheRepositoryIsRead(self):
        files = [*REPOSITORY.glob("cases/*/parameters"), *REPOSITORY.glob("cases/validation/**/parameters")]
        self.assertGreater(len(files), 10)
        for path in files:
            parameterFile.parameters(path)

    def testWhatIsRefused(self):
        """Each in one line with the line's number. Python's own float would take nan, inf and 1_000; a reader that looks for
        `;` only would swallow the next entry where one is missing."""
        for text, words in (("a ;", "1: entry 'a' has no value"), ("a;", "has no value"), ("a 1", "is no entry"),
                            ("a 1\nb 2;", "1: 'a 1' is no entry"), ("a 1;\na 2;", "2: entry 'a' is there twice"),
                            ("a { b 1; }", "is no entry"), ("a 1e999;", "allowed: numbers up to"), ("7 a;", "is no entry"),
                            ("a #calc \"1\";", "is no entry"), ("a #codeStream {};", "is no entry"), ("a \"x;", "is no entry"),
                            ("a #eval{ 1/0 };", "cannot be computed"), ("a 1; }", "is no entry"), ("\0", "is no entry")):
            with self.subTest(text), self.assertRaises(ParameterError) as refused:
                parametersIn(text)
            self.assertIn(words, str(refused.exception))
            self.assertEqual(str(refused.exception).count("\n"), 0)
        for word in ("nan", "inf", "-inf", "1_000", "0x10", "25mm", "1e", "1,5"):
            self.assertEqual(parametersIn(f"a {word};")["a"], word)

    def testNoInputIsSlowOrDeep(self):
        for text in ("a " + "(" * 20000, "a #eval{" + "(" * 900 + ")" * 900 + "};", "a #eval{9**9**9**9};", "/" * 20000 + "\n",
                     "a " + '"' * 20001 + ";", "#" * 20000, "a " + "$a" * 10000 + ";"):
            try:
                parametersIn(text)
            except ParameterError:
                pass


class Changing(unittest.TestCase):
    def testOnlyTheValueChanges(self):
        text = "// b 1;\na 1;  // b 2;\nb\t$a;\n"
        self.assertEqual(withParameters(text, {"b": "x y"}), "// b 1;\na 1;  // b 2;\nb\tx y;\n")

    def testNoValueBreaksOut(self):
        for value in ("", " ", "1; b 2", "1\nb 2", "{ c 1; }", "1 // c", "#include \"x\"", "#calc \"system\"", "1 /* c"):
            with self.subTest(value), self.assertRaises(ParameterError):
                withParameters("a 1;\n", {"a": value})

    def testAnUnknownNameNamesTheNearest(self):
        with self.assertRaisesRegex(ParameterError, r"no entry 'fricton' \(is 'friction' meant\?\); it has: friction, other"):
            withParameters("friction 1;\nother 2;\n", {"fricton": "1"})


class Typed(unittest.TestCase):
    def testMistakesAreTold(self):
        """What a shell passes on, in words, never in a traceback."""
        for arguments, words in (((), "usage: "), (("get", "FILE"), "usage: "), (("evaluate", "1", "2"), "usage: "),
                                 (("set", "FILE", "friction", ".2"), "'friction' sets nothing; allowed: NAME=VALUE")):
            outcome = subprocess.run([REPOSITORY / "scripts" / "parameterFile.py", *arguments], capture_output=True, text=True)
            self.assertEqual(outcome.returncode, 1)
            self.assertIn(words, outcome.stderr)
            self.assertNotIn("Traceback", outcome.stderr)


class Arithmetic(unittest.TestCase):
    def testNumbers(self):
        self.assertAlmostEqual(arithmetic.evaluate("round(0.4/(2540*pi()/6*d**3))", {"d": 2e-3}), 37596)
        self.assertEqual(arithmetic.evaluate("-2*(1 + .5) + max(1, 3)"), 0)

    def testNothingElse(self):
        for text in ("__import__('os').system('true')", "().__class__", "[1]", "'a'*3", "open('x')", "d", "1 if 1 else 2", "1e308*10",
                     "(-1)**.5", "lambda: 1", "f'{1}'", "True", "1;2", "", "sqrt(-1)", "sqrt", "pow(1)", "max()"):
            with self.subTest(text), self.assertRaises(ValueError):
                arithmetic.evaluate(text)


if __name__ == "__main__":
    unittest.main()
