#!/usr/bin/python3
"""Builds the documentation site, follows its links, and holds its reference against the code.

usage: documentation_tests.py BUILD [options of unittest]      BUILD: where the programs have been built, in bin/;
                                                               to be run by tests/support/inEnvironment

The reference marks by labels what is held against the code: the table behind `(entries-X)=` lists the entries of a
dictionary, those behind `(models-X)=` models, behind `(study-X)=` keys of a study file, and so on. The tables below
state what each stands for in the code. A reader of entries in the code that none of them names fails, too.
"""

import html.parser
import re
import subprocess
import sys
import tempfile
import unittest
import urllib.parse
from pathlib import Path
from typing import Mapping, Optional, Sized

REPOSITORY = Path(__file__).resolve().parents[2]
DOCS = REPOSITORY / "docs"
build = REPOSITORY / "build"

# What heads a list of pimpleDemFoam -listModels -> labels of the reference.
MODELS = {
    "fluid": ["models-fluid"],
    "modelType": ["models-modelType"],
    "momCoupleModels": ["models-momCoupleModels"],
    "voidFractionModel": ["models-voidFractionModel"],
    "smoothingModel": ["models-smoothingModel"],
    "selfInducedVelocityCorrection": ["models-selfInducedVelocityCorrection"],
    "coarseGraining": ["models-coarseGraining"],
    "meanPressureGradient": ["models-meanPressureGradient"],
    "turbulentDispersion": ["models-turbulentDispersion"],
    "forceModels": [
        "models-forceModels-drag",
        "models-forceModels-other",
        "models-forceModels-torque",
        "models-forceModels-leftOut",
    ],
    "<drag law>Props { polydispersity }": ["models-polydispersity"],
    "<drag law>Props { wallCorrection { law } }": ["models-wallCorrection"],
    "virtualMassForceProps { law }": ["models-virtualMassForceProps"],
    "historyForceProps { law }": ["models-historyForceProps"],
    "functions { type }": ["models-functions"],
    "DEM/engine": ["models-engine"],
    "turbulenceProperties { simulationType }": ["models-simulationType"],
    "turbulenceProperties { RAS { RASModel } }": ["models-RASModel"],
    "turbulenceProperties { LES { LESModel } }": ["models-LESModel"],
    "energy/heatTransferModel": ["models-heatTransferModel"],
}

# File of each call of requireKnownEntries(), in the order of the calls -> label; None where the call allows no entry.
ENTRIES: dict[str, list[Optional[str]]] = {
    "coupling/couplingStep/couplingSettings.cpp": [
        "entries-couplingProperties",
        "entries-DEM",
        "entries-particleOutput",
        "entries-useDDTvoidfractionProps",
    ],
    "coupling/conservation/conservationCheck.cpp": ["entries-conservationCheck"],
    "coupling/couplingStep/energy.cpp": ["entries-energy"],
    "coupling/couplingStep/turbulentDispersion.cpp": ["entries-turbulentDispersionProps"],
    "coupling/distribution/constDiffSmoothing.cpp": ["entries-constDiffSmoothingProps"],
    "coupling/distribution/gaussianVoidFraction.cpp": ["entries-GaussianProps"],
    "coupling/distribution/voidFractionModel.cpp": ["entries-dividedProps", "entries-dividedProps"],
    "coupling/forces/dragModels.cpp": ["entries-DragProps"],
    "coupling/forces/fluidProperties.cpp": ["entries-stratification"],
    "coupling/forces/fluidStressForces.cpp": [None, None, None],
    "coupling/forces/historyForce.cpp": ["entries-historyForceProps"],
    "coupling/forces/leftOut.cpp": [None],
    "coupling/forces/liftModels.cpp": [None],
    "coupling/forces/lubricationForce.cpp": ["entries-lubricationForceProps"],
    "coupling/forces/torqueModels.cpp": [None],
    "coupling/forces/virtualMassForce.cpp": ["entries-virtualMassForceProps"],
    "coupling/forces/wallCorrection.h": ["entries-wallCorrection"],
    "coupling/functionObjects/massInHopper.cpp": ["entries-massInHopper"],
    "coupling/functionObjects/particleFlux.cpp": ["entries-particleFlux"],
    "coupling/functionObjects/particleHeight.cpp": ["entries-particleHeight"],
    "coupling/functionObjects/particleMeans.cpp": ["entries-particleMeans"],
    "solvers/pimpleDemFoam/liggghtsSetup.cpp": ["entries-groupChanges"],
    "solvers/pimpleDemFoam/pimpleDemFoam.C": ["entries-transportProperties"],
    "solvers/pimpleDemFoam/turbulence.cpp": ["entries-turbulenceProperties"],
}

# File of each list of keys that YamlPlace::allow() is given, in the order of the lists -> label, and what stands before
# the keys there.
KEYS = {
    "identification/study/readStudy.cpp": [
        ("study-simulator", ""),
        ("study-parameters", ""),
        ("study-parameters", "prior."),
        ("study-library", ""),
        ("study-settings", "budget."),
        ("study-settings", "repeats."),
        ("study-settings", "failures."),
        ("study-settings", "inference."),
        ("study-settings", "executor."),
        ("study-root", ""),
    ],
    "identification/study/readConditions.cpp": [
        ("study-feature", ""),
        ("study-column", ""),
        ("study-numbers", ""),
        ("study-measured", ""),
        ("study-conditions", "observable."),
        ("study-conditions", ""),
        ("study-observable", ""),
        ("study-root", "measured."),
    ],
    "identification/study/readEffects.cpp": [("study-effects", ""), ("study-effects", "measured.")],
    "identification/study/readCommonErrors.cpp": [("study-commonErrors", "")],
}


def listed(label: str) -> list[str]:
    """What stands in backquotes in the first cells of the table behind a label: up to the next label or heading."""
    for page in sorted((DOCS / "reference").glob("*.md")):
        text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
        section = rf"^\({re.escape(label)}\)=\n(?:#+ [^\n]*\n)?(.*?)(?=^\(|^#|\Z)"
        match = re.search(section, text, re.DOTALL | re.MULTILINE)
        if match:
            rows = re.sub(r"^\|.*\n\|---.*$", "", match[1], flags=re.MULTILINE)
            cells = re.findall(r"^\|([^|]*)\|", rows, re.MULTILINE)
            return [name for cell in cells for name in re.findall(r"`([^`]+)`", cell)]
    raise AssertionError(f"no page of docs/reference has the label ({label})=")


def in_brackets(text: str, start: int) -> str:
    """From the opening bracket at `start` to the one that closes it."""
    pairs = {"(": ")", "{": "}", "[": "]"}
    expected = []
    for place in range(start, len(text)):
        if text[place] in pairs:
            expected.append(pairs[text[place]])
        elif expected and text[place] == expected[-1]:
            expected.pop()
            if not expected:
                return text[start : place + 1]
    raise AssertionError(f"no bracket closes {text[start:start + 60]}")


def texts_in(code: str) -> list[str]:
    return re.findall(r'"([^"\n]*)"', code)


def lengths(lists: Mapping[str, Sized]) -> dict[str, int]:
    return {name: len(each) for name, each in lists.items()}


def sources(folders: list[str]) -> dict[str, str]:
    """Path -> text of C++ files, without comments."""
    found = {}
    for folder in folders:
        for path in sorted((REPOSITORY / folder).rglob("*")):
            if path.suffix in (".h", ".cpp", ".C"):
                text = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
                found[str(path.relative_to(REPOSITORY))] = text
    return found


class Reference(unittest.TestCase):
    """An empty list on either side fails: each test compares for equality, and some known name must be there."""

    maxDiff = None

    def assert_same(self, of_page: set[str], of_code: set[str], what: str) -> None:
        self.assertEqual(of_code - of_page, set(), f"{what}: in the code, but not in the reference")
        self.assertEqual(of_page - of_code, set(), f"{what}: in the reference, but not in the code")

    def test_every_model_is_there(self) -> None:
        """Against what the program itself lists."""
        command = [str(build / "bin/pimpleDemFoam"), "-listModels"]
        shown = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        models: dict[str, set[str]] = {}
        head = ""
        for line in shown.splitlines():
            if line.startswith("    "):
                models[head].add(line.split()[0])
            elif line.strip():
                head = line.strip()
                models[head] = set()
        self.assertIn("DiFeliceDrag", models["forceModels"])
        self.assertEqual(set(models), set(MODELS), "what -listModels lists")
        for head, labels in MODELS.items():
            self.assert_same({name for label in labels for name in listed(label)}, models[head], head)

    def test_every_entry_is_there(self) -> None:
        """Against all calls of requireKnownEntries()."""
        found: dict[str, list[set[str]]] = {}
        for path, text in sources(["coupling", "solvers"]).items():
            if Path(path).stem != "knownEntries":
                starts = re.finditer(r"\brequireKnownEntries\(", text)
                calls = [in_brackets(text, match.end() - 1) for match in starts]
                if calls:
                    found[path] = [set(re.findall(r'"(\w+)"', call.split(",", 1)[1])) for call in calls]
        self.assertEqual(lengths(found), lengths(ENTRIES), "number of calls in each file")
        self.assertIn("couplingTimeStep", found["coupling/couplingStep/couplingSettings.cpp"][0])
        text = sources(["coupling"])["coupling/knownEntries.cpp"]
        of_all = set(texts_in(in_brackets(text, text.index("{", text.index("wordList functionObjectEntries(")))))
        self.assert_same(set(listed("entries-functionObjects")), of_all, "entries of all function objects")
        for path, labels in ENTRIES.items():
            for label, names in zip(labels, found[path]):
                # the coefficients of models have tables of their own
                names = {name for name in names if not (name.endswith("Props") and name != "useDDTvoidfractionProps")}
                # and so have the entries of all function objects
                names -= of_all if path.startswith("coupling/functionObjects") else set()
                self.assert_same(set(listed(label)) if label else set(), names, f"{path}, {label}")

    def test_every_key_of_a_study_is_there(self) -> None:
        """Against all lists of keys that the readers allow."""
        found: dict[str, list[set[str]]] = {}
        for path, text in sources(["identification"]).items():
            starts = re.finditer(r"(?:\.allow\(\s*|\ballowed = )\{", text)
            lists = [in_brackets(text, match.end() - 1) for match in starts]
            if lists:
                found[path] = [set(texts_in(each)) for each in lists]
        self.assertEqual(lengths(found), lengths(KEYS), "number of lists in each file")
        self.assertIn("simulator", found["identification/study/readStudy.cpp"][-1])
        documented = {label for labels in KEYS.values() for label, _ in labels}
        keys: dict[str, set[str]] = {label: set() for label in documented}
        for path, labels in KEYS.items():
            for (label, before), names in zip(labels, found[path]):
                keys[label] |= {before + name for name in names}
        for label in sorted(documented):
            self.assert_same(set(listed(label)), keys[label], label)

    def test_every_feature_is_there(self) -> None:
        """Kinds, and the parameters of each, against features.cpp."""
        text = sources(["identification/features"])["identification/features/features.cpp"]
        body = text[text.index("makeKinds()") :]
        variables = dict(re.findall(r'FeatureKind::Parameter (\w+)\{"(\w+)"', body))
        kinds = {}
        for match in re.finditer(r'\{"(\w+)",\s*"[^"]*",\s*\{', body):
            list_of_parameters = in_brackets(body, match.end() - 1)
            named = set(re.findall(r'\{"(\w+)"', list_of_parameters[1:]))
            bare = re.sub(r"\{[^{}]*\}", "", list_of_parameters[1:-1])
            kinds[match[1]] = named | {variables[name] for name in re.findall(r"\w+", bare)}
        self.assertIn("logMeanRate", kinds)
        self.assert_same(set(listed("study-features")), set(kinds), "kinds of features")
        page = (DOCS / "reference/features.md").read_text(encoding="utf-8")
        for kind, parameters in kinds.items():
            row = re.search(rf"^\| `{kind}` \|[^\n]*\|([^|\n]*)\|$", page, re.MULTILINE)
            assert row is not None
            self.assert_same(set(re.findall(r"`(\w+)`", row[1])), parameters, kind)

    def test_every_operation_of_the_measuring_chain_is_there(self) -> None:
        text = sources(["identification/effects"])["identification/effects/measuringChain.cpp"]
        operations = set(re.findall(r'^\s*\{"(\w+)", \{"', text, re.MULTILINE))
        self.assertIn("lag", operations)
        self.assert_same(set(listed("study-chain")), operations, "operations")

    def test_every_key_of_a_report_is_there(self) -> None:
        """Against the program that writes it."""
        text = sources(["identification"])["identification/report/json.cpp"]
        body = text[text.index("Json jsonOf(") :]
        keys = set(re.findall(r'^    json\["(\w+)"\] =', body, re.MULTILINE))
        self.assertIn("decision", keys)
        self.assert_same(set(listed("report")), keys, "report.json")

    def test_every_option_is_there(self) -> None:
        code = "".join(sources(["solvers"]).values())
        options = {"-" + name for name in re.findall(r'argList::add(?:Bool)?Option\(\s*"(\w+)"', code)}
        self.assertIn("-dryRun", options)
        self.assert_same(set(listed("options-pimpleDemFoam")), options, "pimpleDemFoam")
        code = sources(["identification"])["identification/traceResidual.cpp"]
        options = set(re.findall(r'add_(?:option|flag)\(\s*"(--\w+)"', code))
        commands = set(re.findall(r'(?:add_subcommand|addCommand)\(\s*"(\w+)"', code))
        self.assertIn("--execute", options)
        self.assert_same(
            {name.split()[0] for name in listed("options-traceResidual")}, options | commands, "traceResidual"
        )

    def test_every_header_is_in_the_interface(self) -> None:
        """A folder of coupling or identification whose headers no page shows would be missed otherwise."""
        pages = "".join(page.read_text(encoding="utf-8") for page in (DOCS / "developers/api").glob("*.md"))
        shown = set(re.findall(r"^:::\{headers\} (\S+)$", pages, re.MULTILINE))
        inner = {"coupling/engine/liggghts", "coupling/engine/liggghts/styles", "identification/study/draft"}
        folders = {
            str(path.parent.relative_to(REPOSITORY))
            for folder in ("coupling", "identification")
            for path in (REPOSITORY / folder).rglob("*.h")
        }
        self.assertIn("coupling/forces", shown)
        self.assert_same(shown, folders - inner - {"identification"}, "folders with headers")


class Pages(unittest.TestCase):
    def test_named_files_are_there(self) -> None:
        """What stands in backquotes and begins with a folder of the repository is a file or a folder of it."""
        folders = "cases|cmake|coupling|docs|identification|meshes|scripts|solvers|tests"
        named, wrong = 0, []
        for page in sorted(DOCS.rglob("*.md")):
            text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
            for name in re.findall(rf"`((?:{folders})/[\w./-]+)`", text):
                named += 1
                # what runs and builds leave is not there in a fresh clone
                made = re.search(r"/(results|steps|stages)(/|$)|^meshes/made", name)
                if not made and not (REPOSITORY / name).exists():
                    wrong.append(f"{page.relative_to(REPOSITORY)}: {name}")
        self.assertGreater(named, 50)
        self.assertEqual(wrong, [], "no such files")


class Targets(html.parser.HTMLParser):
    """Of one page of the site: where its links and pictures lead, and what may be led to."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors = {""}
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, Optional[str]]]) -> None:
        for name, value in attrs:
            if name == "id" and value:
                self.anchors.add(value)
            elif name in ("href", "src") and value:
                self.links.append(value)


class Site(unittest.TestCase):
    def test_builds_without_a_warning_and_every_link_leads_somewhere(self) -> None:
        """Links within the site, to pages and to places on them, pictures and scripts. One build serves for both."""
        with tempfile.TemporaryDirectory(prefix="clepsydra-documentation-") as folder:
            command = [str(REPOSITORY / "scripts/documentation"), "--output", folder]
            run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stdout)
            site = Path(folder) / "html"
            pages = {page: Targets(page) for page in sorted(site.rglob("*.html"))}
            self.assertIn(site / "reference/couplingProperties.html", pages)
            self.assertIn("couplingTimeStep", (site / "reference/couplingProperties.html").read_text(encoding="utf-8"))
            # files outside of docs/ are pages as well
            tutorials = sorted(REPOSITORY.glob("cases/tutorials/*/README.md"))
            self.assertGreater(len(tutorials), 5)
            for readme in tutorials:
                self.assertIn(site / f"tutorials/{readme.parent.name}.html", pages)
            self.assertIn("Keep a Changelog", (site / "changelog.html").read_text(encoding="utf-8"))
            wrong, followed = [], 0
            for page, found in pages.items():
                for link in found.links:
                    parts = urllib.parse.urlsplit(link)
                    if parts.scheme in ("http", "https", "mailto", "data"):
                        continue
                    followed += 1
                    path = urllib.parse.unquote(parts.path)
                    target = (page.parent / path).resolve() if path else page.resolve()
                    target = target / "index.html" if target.is_dir() else target
                    known = pages.get(target)
                    anchor = urllib.parse.unquote(parts.fragment)
                    if not target.is_file() or (known is not None and anchor not in known.anchors):
                        wrong.append(f"{page.relative_to(site)}: {link}")
            self.assertGreater(followed, 1000)
            self.assertEqual(wrong, [], "links that lead nowhere")
            # what shows formulas comes with the site
            self.assertTrue((site / "_static/mathjax/MathJax.js").is_file())
            fetched = r'<(?:script|link|img)[^>]*(?:src|href)="(https?:[^"]*)"'
            from_network = {url for page in pages for url in re.findall(fetched, page.read_text(encoding="utf-8"))}
            self.assertEqual(from_network, set(), "fetched from the network")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build = Path(sys.argv.pop(1)).resolve()
    unittest.main()
