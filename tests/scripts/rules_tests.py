"""The file parameters.rules: a case that no script has heard of states its own; what it says, and its mistakes."""

import tempfile
import unittest
from pathlib import Path
from typing import Any

from clepsydra import case_rules, parameter_file

REPOSITORY = Path(__file__).resolve().parents[2]

PARAMETERS = "length 2;\nwidth 0.5;\ncount 10;\nshape box;\n"
RULES = """
entries:
  length: {from: 1e-3, to: 10, unit: m}
  width: {from: 1e-3, to: 10, unit: m}
  count: {from: 1, to: 1e6, whole: yes}
  shape: {words: [box, tube, on]}
define:
  area: length * width
  tubeArea: {value: pi() / 4 * width**2, when: shape == 'tube'}
  withoutValue: {closure: noSuchFormula, options: []}
together:
  - {require: width < length, message: "width {width:g} m; allowed: less than length, {length:g} m"}
  - {expect: area > 0.5 and not count > 100, message: "area {area:.2f} m2"}
  - {require: count < 5, when: shape == 'tube', message: "count {count:.0f} of a {shape}"}
  - {expect: count < 5, notFor: [mesh], message: "count is {count:.0f}"}
  - {require: count < 5, here: yes, message: "count here"}
  - {fact: "area {area:g} m2"}
  - {fact: "of the tube {tubeArea:.3f} m2"}
  - {fact: "never reported: {withoutValue}"}
"""


class Rules(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-rules-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def found(
        self, parameters: Any = PARAMETERS, rules: Any = RULES, ranks: int | None = None, part: Any = "mesh"
    ) -> Any:
        (self.folder / "parameters.rules").write_text(rules)
        return case_rules.Rules(self.folder).check(parameters, ranks, part, "parameters")

    def test_right_parameters_have_facts_alone(self) -> None:
        """The tube's fact and that without a value are left out; a check that skipped all would miss the area."""
        found = self.found()
        self.assertEqual((found.problems, found.warnings, found.facts), ([], [], ["area 1 m2"]))

    def test_what_is_required_stops_and_what_is_expected_warns(self) -> None:
        found = self.found(PARAMETERS.replace("width 0.5", "width 3"))
        self.assertEqual(found.problems, ["parameters: width 3 m; allowed: less than length, 2 m"])
        found = self.found(PARAMETERS.replace("width 0.5", "width 0.1"))
        self.assertEqual((found.problems, found.warnings), ([], ["parameters: area 0.20 m2"]))

    def test_conditions_restrict(self) -> None:
        """Each once where it applies and once where it does not."""
        found = self.found(PARAMETERS.replace("box", "tube"))
        self.assertEqual(found.problems, ["parameters: count 10 of a tube"])
        self.assertEqual(found.facts, ["area 1 m2", "of the tube 0.196 m2"])
        self.assertEqual(self.found(part="all").warnings, ["parameters: count is 10"])
        self.assertEqual(self.found(ranks=1).problems, ["parameters: count here"])

    def test_entries_alone(self) -> None:
        for old, new, words in (
            ("count 10", "count 1.5", "entry 'count' is 1.5; allowed: a whole number from 1 to 1000000"),
            ("length 2", "length 20", "entry 'length' is 20; allowed: a number from 0.001 to 10 [m]"),
            ("shape box", "shape bax", "entry 'shape' is bax; allowed: box, tube, on"),
            ("count 10", "cuont 10", "entry 'cuont' is unknown (is 'count' meant?)"),
        ):
            with self.subTest(new):
                self.assertIn(words, "\n".join(self.found(PARAMETERS.replace(old, new)).problems))

    def test_an_entry_that_the_case_refers_to_is_the_users_own(self) -> None:
        (self.folder / "system").mkdir()
        (self.folder / "system/controlDict").write_text("endTime $mine;\n")
        self.assertEqual(self.found(PARAMETERS + "mine 3;\n").problems, [])

    def test_mistakes_of_the_rules_are_named(self) -> None:
        """In words that name the file, whatever is wrong; none may be passed over as a rule that holds."""
        for old, new, words in (
            ("entries:", "entires:", "unknown entry 'entires' (is 'entries' meant?)"),
            ("unit: m}", "units: m}", "unknown entry 'units'"),
            ("require: width < length", "require: width", "is no condition"),
            ("require: width < length", "require: width < shape", "cannot be compared"),
            ("require: width < length", "require: 'width <'", "is no expression"),
            ("require: width < length", "require: width < lenght", "there is no 'lenght' (is 'length' meant?)"),
            ("{width:g} m; allowed", "{widht:g} m; allowed", "there is no 'widht'"),
            ("area: length * width", "area: length.__class__", "is no arithmetic"),
            ("length: {from: 1e-3, to: 10, unit: m}", "length: {from: 1e-3}", "KeyError 'to'"),
            ('message: "width', 'massage: "width', "unknown entry 'massage'"),
            ("entries:", "entries: [", "while parsing"),
        ):
            with self.subTest(new):
                with self.assertRaises(case_rules.RulesError) as problem:
                    self.found(PARAMETERS.replace("width 0.5", "width 3"), RULES.replace(old, new))
                self.assertIn(words, str(problem.exception))
                self.assertIn("parameters.rules", str(problem.exception))

    def test_rules_run_nothing(self) -> None:
        made = self.folder / "made"
        for text in (f"__import__('os').system('touch {made}') < 1", f"open('{made}', 'w') == 1"):
            with self.assertRaises(case_rules.RulesError):
                self.found(rules=RULES.replace("width < length", '"' + text + '"'))
        self.assertFalse(made.exists())

    def test_each_tutorials_own_parameters_are_right(self) -> None:
        """As they are in the repository; with an entry too many, and without one, they are refused."""
        cases = sorted(path.parent for path in (REPOSITORY / "cases/tutorials").glob("*/parameters"))
        self.assertGreaterEqual(len(cases), 6)
        for case in cases:
            with self.subTest(case.name):
                rules, text = case_rules.Rules(case), (case / "parameters").read_text()
                self.assertEqual(rules.check(text, 1, "all", "parameters").problems, [])
                self.assertNotEqual(rules.check(text + "misspelt 1;\n", 1, "all", "parameters").problems, [])
                without = "".join(line for line in text.splitlines(True) if not line.startswith("particleDensity"))
                self.assertIn(
                    "entry 'particleDensity' is missing", rules.check(without, 1, "all", "parameters").problems[0]
                )

    def test_the_exit_of_a_hopper_ends_above_the_floor(self) -> None:
        """Else the pipe below the orifice would reach through the floor of the tank, and nothing would leave it."""
        for name in ("hopperQuick", "hopperSubmerged"):
            case = REPOSITORY / "cases/tutorials" / name
            text = parameter_file.with_parameters(
                (case / "parameters").read_text(), {"tankDepth": "0.03", "landHeight": "0.029", "bevelHeight": "1e-3"}
            )
            problems = case_rules.Rules(case).check(text, None, "mesh", "parameters").problems
            self.assertIn(
                "parameters: landHeight 0.029 m and bevelHeight 0.001 m; allowed: together less than tankDepth, 0.03 m",
                problems,
            )


if __name__ == "__main__":
    unittest.main()
