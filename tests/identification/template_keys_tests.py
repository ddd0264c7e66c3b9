"""Every name in the report's templates is a key of report.json, in the place where the template reads it.

A name that no report has leaves its cell empty without a word. The keys are those of the committed reports; what
html.cpp adds is listed here.
"""

import json
import re
import unittest
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent.parent
REPORT = ROOT / "identification" / "report"
PLOTS = dict.fromkeys(("fitted", "heldOut", "fittedNumbers", "heldOutNumbers", "errors"), "")
OF_NUMBERS = {"short", "p", "text", "share", "percent"}  # text.cpp: the forms of a number or an estimate
OF_TABLES = {"is", "name", "unit", "inErrors", "isLarge"}  # html.cpp: columns that it adds, by the value's name
BY_NAME = {
    "measuredMinusSimulated",
    "byPurpose",
    "features",
}  # objects that html.cpp turns into lists of name and value

TAG = re.compile(r"{{([#^/{]?)([^{}]+?)}?}}")


def merged(a: Any, b: Any) -> Any:
    """An example of all keys: objects key by key, lists as one object that has the keys of all elements."""
    if isinstance(b, list):
        element: Any = None
        for item in b:
            element = merged(element, item)
        b = element
    if isinstance(a, dict) and isinstance(b, dict):
        return {key: merged(a.get(key), b.get(key)) for key in a.keys() | b.keys()}
    return a if b is None else b


def unknown_names(template: str, report: Any) -> list[str]:
    """The names that are neither keys where they are read nor what html.cpp adds."""
    unknown = []
    contexts: list[Any] = [report]

    def found(name: str) -> tuple[bool, Any]:
        if name == ".":
            return True, contexts[-1]
        first, *rest = name.lstrip(".").split(".")
        holder = next((c for c in reversed(contexts) if isinstance(c, dict) and first in c), None)
        if holder is None:
            return first in OF_NUMBERS | OF_TABLES, None
        value = holder[first]
        for key in rest:
            if not isinstance(value, dict) or key not in value:
                return key in OF_NUMBERS, None
            value = value[key]
        return True, value

    for kind, name in TAG.findall(template):
        if kind == "/":
            contexts.pop()
            continue
        known, value = found(name)
        if not known:
            unknown.append(name)
        if kind in ("#", "^"):
            if name in BY_NAME and isinstance(value, dict):
                value = {"is": next(iter(value.values()), None)}
            contexts.append(value)
    return unknown


class Templates(unittest.TestCase):
    report: Any = None

    @classmethod
    def setUpClass(cls) -> None:
        for file in sorted((ROOT / "cases").glob("**/results/report.json")):
            cls.report = merged(cls.report, json.loads(file.read_text(encoding="utf-8")))
        cls.report["plots"] = PLOTS

    def test_names_are_keys(self) -> None:
        for file in ("page.mustache", "summary.mustache"):
            with self.subTest(file=file):
                self.assertEqual(unknown_names((REPORT / file).read_text(encoding="utf-8"), self.report), [])

    def test_a_renamed_key_is_found(self) -> None:
        page = (REPORT / "page.mustache").read_text(encoding="utf-8")
        report = json.loads(json.dumps(self.report))
        predicted = report["nextExperiment"]["predicted"]
        predicted["weight"] = predicted.pop("probability")
        self.assertEqual(unknown_names(page, report), ["probability.share"])


if __name__ == "__main__":
    unittest.main()
