"""clepsydra.parameter_file and clepsydra.arithmetic: what is read, what is refused, what is never run."""

import subprocess
import tempfile
import unittest
from pathlib import Path

from clepsydra import arithmetic, parameter_file
from clepsydra.old_names import NEW_NAMES
from clepsydra.parameter_file import ParameterError, parameters_in, with_parameters

REPOSITORY = Path(__file__).resolve().parents[2]


class Reading(unittest.TestCase):
    def test_what_open_foam_allows(self) -> None:
        """Comments, references, words, vectors, tables, strings and #eval, as the cases of this repository have
        them."""
        text = """FoamFile { version 2.0; }
        /* a comment; over
           lines */
        a 2e-3;  // b 7;
        b $a; c ${a}; d #eval{ 3*$a };
        law DiFeliceDrag; forces gradPForce viscForce; U constant (0 0 -1); T table ((0 (0 0 1)) (1 (0 0 2)));
        script "DEM/in.x // no; comment"; _underscore -.5;"""
        self.assertEqual(
            parameters_in(text),
            {
                "a": 2e-3,
                "b": 2e-3,
                "c": 2e-3,
                "d": 6e-3,
                "law": "DiFeliceDrag",
                "forces": "gradPForce viscForce",
                "U": "constant (0 0 -1)",
                "T": "table ((0 (0 0 1)) (1 (0 0 2)))",
                "script": '"DEM/in.x // no; comment"',
                "_underscore": -0.5,
            },
        )

    def test_every_file_of_the_repository_is_read(self) -> None:
        files = [*REPOSITORY.glob("cases/*/*/parameters"), *REPOSITORY.glob("cases/validation/**/parameters")]
        self.assertGreater(len(files), 10)
        for path in files:
            parameter_file.parameters(path)

    def test_what_is_refused(self) -> None:
        """Each in one line with the line's number. Python's own float would take nan, inf and 1_000; a reader that
        looks for `;` only would swallow the next entry where one is missing."""
        for text, words in (
            ("a ;", "1: entry 'a' has no value"),
            ("a;", "has no value"),
            ("a 1", "is no entry"),
            ("a 1\nb 2;", "1: 'a 1' is no entry"),
            ("a 1;\na 2;", "2: entry 'a' is there twice"),
            ("a { b 1; }", "is no entry"),
            ("a 1e999;", "allowed: numbers up to"),
            ("7 a;", "is no entry"),
            ('a #calc "1";', "is no entry"),
            ("a #codeStream {};", "is no entry"),
            ('a "x;', "is no entry"),
            ("a #eval{ 1/0 };", "cannot be computed"),
            ("a 1; }", "is no entry"),
            ("\0", "is no entry"),
        ):
            with self.subTest(text), self.assertRaises(ParameterError) as refused:
                parameters_in(text)
            self.assertIn(words, str(refused.exception))
            self.assertEqual(str(refused.exception).count("\n"), 0)
        for word in ("nan", "inf", "-inf", "1_000", "0x10", "25mm", "1e", "1,5"):
            self.assertEqual(parameters_in(f"a {word};")["a"], word)

    def test_no_input_is_slow_or_deep(self) -> None:
        for text in (
            "a " + "(" * 20000,
            "a #eval{" + "(" * 900 + ")" * 900 + "};",
            "a #eval{9**9**9**9};",
            "/" * 20000 + "\n",
            "a " + '"' * 20001 + ";",
            "#" * 20000,
            "a " + "$a" * 10000 + ";",
        ):
            try:
                parameters_in(text)
            except ParameterError:
                pass


class Changing(unittest.TestCase):
    def test_only_the_value_changes(self) -> None:
        text = "// b 1;\na 1;  // b 2;\nb\t$a;\n"
        self.assertEqual(with_parameters(text, {"b": "x y"}), "// b 1;\na 1;  // b 2;\nb\tx y;\n")

    def test_no_value_breaks_out(self) -> None:
        for value in ("", " ", "1; b 2", "1\nb 2", "{ c 1; }", "1 // c", '#include "x"', '#calc "system"', "1 /* c"):
            with self.subTest(value), self.assertRaises(ParameterError):
                with_parameters("a 1;\n", {"a": value})

    def test_an_unknown_name_names_the_nearest(self) -> None:
        with self.assertRaisesRegex(
            ParameterError, r"no entry 'fricton' \(is 'friction' meant\?\); it has: friction, other"
        ):
            with_parameters("friction 1;\nother 2;\n", {"fricton": "1"})

    def test_a_case_on_top_of_its_template(self) -> None:
        """Other values, then entries of its own; what looks like a misspelt entry of the template is refused, and
        neither file is changed."""
        with tempfile.TemporaryDirectory(prefix="clepsydra-parameters-") as folder:
            template, case = Path(folder) / "template", Path(folder) / "case"
            template.write_text("width 1;  // m\nsides noSlip;\n")
            case.write_text("depth 3;\nwidth 2;\n")
            parameter_file.merge(str(template), str(case))
            merged = template.read_text()
            self.assertIn("width 2;  // m", merged)
            self.assertEqual(parameters_in(merged), {"width": 2.0, "sides": "noSlip", "depth": 3.0})
            case.write_text("width 5; widht 3;\n")
            with self.assertRaisesRegex(ParameterError, "case: the template .* no entry 'widht' .is 'width' meant"):
                parameter_file.merge(str(template), str(case))
            self.assertEqual(template.read_text(), merged)


class OldNames(unittest.TestCase):
    """Entries were renamed in version 1.0.0. Without the table an old entry would be unknown to some readers, unseen by
    others."""

    def test_an_old_entry_is_refused_with_its_new_name(self) -> None:
        with self.assertRaisesRegex(ParameterError, r"parameters:2: entry 'pourTime' .* allowed: 'fillingTime'"):
            parameters_in("friction 1;\npourTime 2;\n")

    def test_an_old_name_cannot_be_set(self) -> None:
        with self.assertRaisesRegex(ParameterError, r"no entry 'beadCount' \(its name is 'particleCount' now\)"):
            with_parameters("particleCount 1;\n", {"beadCount": "2"})

    def test_every_new_name_is_an_entry_of_a_case(self) -> None:
        cases = ("tutorials/hopperQuick", "validation/common/column")
        known = {
            name for case in cases for name in parameter_file.parameters(REPOSITORY / "cases" / case / "parameters")
        }
        self.assertLessEqual(set(NEW_NAMES.values()), known)
        self.assertFalse(set(NEW_NAMES) & known)


class Typed(unittest.TestCase):
    def test_mistakes_are_reported(self) -> None:
        """What a shell passes on, in words, never in a traceback."""
        for arguments, status, words in (
            ((), 2, "usage: "),
            (("get", "FILE"), 2, "usage: "),
            (("evaluate", "1", "2"), 2, "usage: "),
            (("set", "FILE", "friction", ".2"), 1, "'friction' sets nothing; allowed: NAME=VALUE"),
        ):
            outcome = subprocess.run(
                [REPOSITORY / "scripts" / "parameterFile", *arguments], capture_output=True, text=True
            )
            self.assertEqual(outcome.returncode, status)
            self.assertIn(words, outcome.stderr)
            self.assertNotIn("Traceback", outcome.stderr)


class Arithmetic(unittest.TestCase):
    def test_numbers(self) -> None:
        self.assertAlmostEqual(arithmetic.evaluate("round(0.4/(2540*pi()/6*d**3))", {"d": 2e-3}), 37596)
        self.assertEqual(arithmetic.evaluate("-2*(1 + .5) + max(1, 3)"), 0)

    def test_nothing_else(self) -> None:
        for text in (
            "__import__('os').system('true')",
            "().__class__",
            "[1]",
            "'a'*3",
            "open('x')",
            "d",
            "1 if 1 else 2",
            "1e308*10",
            "(-1)**.5",
            "lambda: 1",
            "f'{1}'",
            "True",
            "1;2",
            "",
            "sqrt(-1)",
            "sqrt",
            "pow(1)",
            "max()",
        ):
            with self.subTest(text), self.assertRaises(ValueError):
                arithmetic.evaluate(text)


if __name__ == "__main__":
    unittest.main()
