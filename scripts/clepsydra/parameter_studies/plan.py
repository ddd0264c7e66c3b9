"""From a parameter study's file to its list of tasks.

A task is one command `Allrun [-np RANKS] PART` in a folder of its own, a copy of the template case with some of its
parameters replaced. What runs have in common (the mesh, the packing) is a task as well, on which they depend.
"""

import dataclasses
import hashlib
import itertools
import json
import re
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any, Iterable, Iterator

import yaml

from clepsydra import arithmetic, case_rules, parameter_file, parameter_study_results
from clepsydra.case_rules import Findings
from clepsydra.environment import REPOSITORY

PARAMETER_STUDY_ENTRIES = {
    "base": "a file with more of these entries",
    "case": "the template's folder",
    "work": "folder of the runs (default: work)",
    "results": "folder of the results (default: results)",
    "ranks": "of each run (default: 1)",
    "steps": "of each run",
    "packings": "values of the template's seed",
    "parameters": "of all runs",
    "runs": "the list",
    "keepTimes": "all, or a number (default: all)",
}
TEMPLATE_ENTRIES = ("shared", "steps", "mayChange", "seed", "summary", "derived")

RUN_ENTRIES = ("sweep", "parameters", "filling", "steps", "packings", "ranks")


class ParameterStudyError(Exception):
    """What is wrong with a parameter study's file, in words for its author."""


@dataclass(frozen=True)
class Task:
    name: str  # also its folder below the parameter study's work folder
    part: str  # what Allrun is asked for
    ranks: int
    overrides: tuple  # (parameter, text) pairs
    needs: tuple  # names of tasks
    links: tuple  # (path in the case, task that makes it) pairs
    publish: str  # stem of its result files; empty: none
    entry: str  # the parameter study's entry that it belongs to


class ParameterStudy:
    """A parameter study file and its template, read and checked. ParameterStudyError where anything is wrong.

    only: of its entries `runs` these; all unless given. missing: only runs that have no results yet, and what they
    need."""

    def __init__(self, path: Path | str, only: list[str] | None = None, missing: bool = False) -> None:
        self.path = Path(path).resolve()
        # {file of results: names of the parameters that are others now}; only where `missing` looks at them
        self.outdated: dict[str, list[str]] = {}
        try:
            self._read(only)
            if missing:
                self._drop_published()
        except parameter_file.ParameterError as problem:
            raise ParameterStudyError(problem) from None

    def _read(self, only: list[str] | None) -> None:
        self.settings = read_yaml(self.path, PARAMETER_STUDY_ENTRIES, required=())
        of_base = None
        if "base" in self.settings:
            base = read_yaml(self._folder("base"), PARAMETER_STUDY_ENTRIES, required=())
            of_base = base.get("parameters")
            # paths are relative to the file that has them
            base |= {
                name: str(found(base[name], self._folder("base").parent))
                for name in ("case", "work", "results")
                if name in base
            }
            self.settings = {**base, **self.settings}
        for name in ("case", "steps", "runs"):
            if name not in self.settings:
                raise ParameterStudyError(f"{self.path}: entry '{name}' is missing")
        self.work = self._folder("work", "work")
        # the template as it was when the parameter study began, once it has begun
        self.frozen_case = self.work / "case"
        self.case = self.frozen_case if self.frozen_case.exists() else self._folder("case")
        self.results = self._folder("results", "results")
        require_plain(self.work, REPOSITORY)
        self.template = read_yaml(
            self.case / "template.yaml", TEMPLATE_ENTRIES, required=("shared", "steps", "seed", "summary")
        )
        self.derived = self.template.get("derived", {})
        self.defaults = parameter_file.parameters(self.case / "parameters")
        self.given = self._together(
            *(self._overrides(given, "parameters") for given in (of_base, self.settings.get("parameters")))
        )
        self.common = self._derive(self.given)
        self.keep_times = self._keep_times()
        self.tasks = self._plan(only)

    def _keep_times(self) -> int | None:
        """How many times of a run stay on disk; None for all."""
        kept = self.settings.get("keepTimes", "all")
        if kept != "all" and not (isinstance(kept, int) and kept > 1):
            raise self._error("keepTimes", kept, "all, or a whole number above 1")
        return None if kept == "all" else kept

    def _drop_published(self) -> None:
        published = parameter_study_results.files(self.results)
        left = []
        for task in self.tasks.values():
            path = published.get(task.publish)
            changed = self._changed_since(path, task) if path else []
            if changed:
                self.outdated[str(path)] = changed
            if task.publish and (changed or not path):
                left.append(task)
        names = {task.name for task in left}
        for task in left:
            names.update(task.needs, *(self.tasks[need].needs for need in task.needs))
        self.tasks = {name: task for name, task in self.tasks.items() if name in names}

    def matters(self, name: str) -> bool:
        """Whether another value makes another run: not of how long a step lasts, nor of what may change."""
        return name not in {*self.template["steps"].values(), *self.template.get("mayChange", ())}

    def _changed_since(self, published: parameter_study_results.File, task: Task) -> list[str]:
        """Names of the parameters that the parameter study sets to other values than those of published results. What
        it does not set is the template's, which may be another by now."""
        try:
            before = dict(json.loads(published.read_text())["parameters"])
        except (ValueError, KeyError, TypeError):
            raise ParameterStudyError(
                f"{published}: no dictionary 'parameters' in it; allowed: the JSON of a run's results, or no such file"
            ) from None
        now = self.parameters(task)
        return [name for name, _ in task.overrides if self.matters(name) and before.get(name) != now[name]]

    def parameter_text(self, task: Task) -> str:
        """The task's file `parameters`."""
        return self._text(dict(task.overrides))

    def parameters(self, task: Task) -> dict[str, Any]:
        return self._resolved(dict(task.overrides))

    def check(self, executor: str) -> dict[str, Findings]:
        """{name: what is known of it} of all tasks; ParameterStudyError where the template's parameters.rules refuse
        the parameters of any.

        Slurm's tasks run on other machines than this one: what fits there, each finds when it starts."""
        if not (self.case / case_rules.FILE).exists():
            return {}
        try:
            return self._check(case_rules.Rules(self.case), executor)
        except case_rules.RulesError as problem:
            raise ParameterStudyError(str(problem)) from None

    def _check(self, rules: Any, executor: str) -> Any:
        known, seen, problems = {}, {}, []
        for name, task in self.tasks.items():
            # runs of one set of parameters are checked once
            key = task.overrides, task.ranks, task.part
            if key not in seen:
                seen[key] = rules.check(
                    self.parameter_text(task),
                    task.ranks if executor == "local" else None,
                    task.part,
                    f"{self.path}: {name}",
                )
            known[name] = seen[key]
            problems += [problem for problem in known[name].problems if problem not in problems]
        if problems:
            raise ParameterStudyError("\n".join(problems))
        return known

    def folder(self, task: Task) -> Path:
        return self.work / task.name

    def end_time(self, task: Task) -> float:
        """Simulated seconds, at most; None for a part that simulates nothing."""
        name = self.template["steps"].get(task.part)
        return name and float(self.parameters(task)[name])

    def _folder(self, entry: str, default: Any = None) -> Path:
        return found(self.settings.get(entry, default), self.path.parent)

    def _error(self, entry: str, value: Any, allowed: str) -> ParameterStudyError:
        return ParameterStudyError(f"{self.path}: entry '{entry}' is {value!r}; allowed: {allowed}")

    def _overrides(self, given: Any, entry: str) -> dict[Any, Any]:
        """The parameters given, as text, all of them known to the template."""
        if not isinstance(given or {}, dict):
            raise self._error(entry, given, "a list of `name: value`")
        for name in given or {}:
            if name not in self.defaults and name not in self.derived:
                known = [*self.defaults, *self.derived]
                raise self._error(
                    entry,
                    name,
                    f"the template's parameters{parameter_file.meant(str(name), known)}, which are " + ", ".join(known),
                )
        for name in given or {}:
            others = [other for other in given if other != name and self._sets(other) == self._sets(name)]
            if others:
                raise self._error(entry, ", ".join([name, *others]), f"one of them: each sets {self._sets(name)}")
        return {name: parameter_value(value) for name, value in (given or {}).items()}

    def _sets(self, name: str) -> str:
        """The parameter that a name stands for: another one where the template derives it."""
        return self.derived.get(name, {"sets": name})["sets"]

    def _together(self, *levels: dict[str, Any]) -> dict[str, Any]:
        """For each parameter what the last level says that sets it, itself or by a name from which it is derived."""
        latest = {self._sets(name): (name, value) for level in levels for name, value in level.items()}
        return dict(latest.values())

    def _derive(self, overrides: dict[str, Any]) -> dict[str, Any]:
        """The parameters that follow from what the parameter study says in their place."""
        plain = {name: value for name, value in overrides.items() if name not in self.derived}
        known = self._resolved(plain) | {"pi": pi}
        for name in overrides.keys() - plain.keys():
            rule = self.derived[name]
            try:
                plain[rule["sets"]] = str(arithmetic.evaluate(rule["to"], known | {name: float(overrides[name])}))
            except ValueError as problem:
                raise ParameterStudyError(
                    f"{self.path}: '{name}' is {overrides[name]!r}, and {rule['to']!r} {problem}"
                ) from None
        return plain

    def _plan(self, only: list[str] | None) -> dict[str, Any]:
        tasks: dict[str, Any] = {}
        runs = self.settings["runs"]
        if not (isinstance(runs, dict) and runs and all(isinstance(entry or {}, dict) for entry in runs.values())):
            raise self._error("runs", runs, "a list of `name: { ... }`")
        unknown = [name for name in only or [] if name not in runs]
        if unknown:
            raise ParameterStudyError(
                f"{self.path}: no run '{unknown[0]}'{parameter_file.meant(unknown[0], runs)}; "
                f"there are: {', '.join(map(str, runs))}"
            )
        for name, entry in runs.items():
            if only and name not in only:
                continue
            for task in self._tasks_of(str(name), entry or {}):
                known = tasks.setdefault(task.name, task)
                if known.overrides != task.overrides:
                    raise ParameterStudyError(f"{self.path}: two different runs are both named {task.name}")
        return tasks

    def _tasks_of(self, name: str, entry: Any) -> Iterator[Task]:
        unknown = set(entry) - set(RUN_ENTRIES)
        if unknown:
            raise self._error(f"runs/{name}", ", ".join(sorted(unknown)), ", ".join(RUN_ENTRIES))
        if not re.fullmatch(r"[\w.+-]+", name):
            raise self._error("runs", name, "names of letters, digits and . _ + -")
        fixed = self._overrides(entry.get("parameters"), f"runs/{name}/parameters")
        of_filling = self._overrides(entry.get("filling"), f"runs/{name}/filling")
        self._check_filling(of_filling, f"runs/{name}/filling")
        sweep = entry.get("sweep") or {}
        self._overrides(sweep, f"runs/{name}/sweep")
        for values in itertools.product(
            *(self._listed(values, f"runs/{name}/sweep/{swept}") for swept, values in sweep.items())
        ):
            swept = dict(zip(sweep, map(parameter_value, values)))
            case = "-".join([name, *swept.values()])
            for seed in self._of_run("packings", name, entry, [None]):
                overrides = self._derive(self._together(self.given, fixed, swept))
                if seed is not None:
                    self._refuse_seed(fixed | swept, f"runs/{name}")
                    overrides[self.template["seed"]] = parameter_value(seed)
                yield from self._tasks_of_run(name, safe_name(case), entry, overrides, of_filling)

    def _of_run(self, what: str, name: str, entry: Any, default: Any = None) -> list[Any]:
        """The list `what` of a run's entry, else that of the whole file."""
        if what in entry:
            return self._listed(entry[what], f"runs/{name}/{what}")
        return self._listed(self.settings.get(what, default), what)

    def _refuse_seed(self, own: dict[str, Any], entry: str) -> None:
        seed = self.template["seed"]
        if seed in own:
            raise self._error(f"{entry}, {seed}", own[seed], f"no {seed}: `packings` are its values")

    def _listed(self, values: Any, entry: str) -> list[Any]:
        if values == []:
            raise self._error(entry, values, "a value, or a list of one or more: of an empty list no run is made")
        return as_list(values)

    def _check_filling(self, of_filling: dict[str, Any], entry: str) -> None:
        known = self.template["shared"]["filling"]["dependsOn"]
        for name in of_filling:
            if self._sets(name) not in known:
                allowed = [*known, *(other for other in self.derived if self._sets(other) in known)]
                raise self._error(
                    entry,
                    name,
                    "the parameters on which the template's filling depends, which are " + ", ".join(allowed),
                )

    def _tasks_of_run(
        self, entry_name: str, case: str, entry: Any, overrides: dict[str, Any], of_filling: Any
    ) -> Iterator[Task]:
        ranks = entry.get("ranks", self.settings.get("ranks", 1))
        if not (isinstance(ranks, int) and ranks > 0):
            raise self._error("ranks", ranks, "a whole number above 0")
        filling = self._shared("filling", overrides, of_filling)
        # the packing's own mesh serves no more than to tell where the hopper is: it need not be the run's
        filling_mesh, mesh = self._shared("mesh", dict(filling.overrides), {}), self._shared("mesh", overrides, {})
        yield filling_mesh
        yield mesh
        yield with_needs(filling, self._links(filling_mesh))
        seed = self._resolved(overrides)[self.template["seed"]]
        for step in self._of_run("steps", entry_name, entry):
            if step not in self.template["steps"] or step in self.template["shared"]:
                allowed = [name for name in self.template["steps"] if name not in self.template["shared"]]
                raise self._error("steps", step, ", ".join(allowed))
            name = f"{case}.{seed:.10g}.{step}"
            run = Task(f"runs/{name}", step, ranks, tuple(sorted(overrides.items())), (), (), name, entry_name)
            yield with_needs(run, self._links(mesh) + self._links(filling))

    def _shared(self, part: str, overrides: dict[str, Any], own: dict[str, Any]) -> Task:
        """The task of a shared part, named by the values of the parameters on which it depends. overrides: the run's;
        own: those that the part alone has."""
        about = self.template["shared"][part]
        of_run = {
            name: value
            for name, value in overrides.items()
            if name in about["dependsOn"] and name not in about.get("fixed", ())
        }
        overrides = self._derive(self._together(self.common, of_run, own))
        values = self._resolved(overrides)
        code = hashlib.sha256(repr([(name, values[name]) for name in about["dependsOn"]]).encode()).hexdigest()[:8]
        return Task(f"shared/{part}-{code}", part, 1, tuple(sorted(overrides.items())), (), (), "", part)

    def _links(self, task: Task) -> tuple[tuple[str, str], ...]:
        return tuple((made, task.name) for made in self.template["shared"][task.part]["makes"])

    def _resolved(self, overrides: dict[str, Any]) -> dict[str, Any]:
        return parameter_file.parameters_in(self._text(overrides), self.case / "parameters")

    def _text(self, overrides: dict[str, Any]) -> str:
        path = self.case / "parameters"
        return parameter_file.with_parameters(parameter_file.read(path), overrides, path)


def found(path: Path, folder: Path) -> Path:
    """Where a path of a parameter study's file leads: relative to the file's folder, or it begins with $CLEPSYDRA."""
    return (folder / str(path).replace("$CLEPSYDRA", str(REPOSITORY))).resolve()


def require_plain(*folders: Any) -> None:
    for folder in folders:
        if re.search(r"[\s\"']", str(folder)):
            raise ParameterStudyError(f"'{folder}' has a space or a quote in it, which OpenFOAM cannot bear; move it")


class OnceEach(yaml.SafeLoader):
    """YAML in which no key may be there twice: the first would be ignored in silence."""

    def construct_mapping(self, node: Any, deep: bool = False) -> dict[Any, Any]:
        keys = [key.value for key, _ in node.value]
        for key, _ in node.value:
            if keys.count(key.value) > 1:
                raise yaml.constructor.ConstructorError(
                    None, None, f"entry '{key.value}' is there twice", key.start_mark
                )
        return super().construct_mapping(node, deep)


def read_yaml(path: Path, allowed: Iterable[str], required: Iterable[str]) -> dict[str, Any]:
    try:
        found = yaml.load(path.read_text(), OnceEach)
    except OSError as problem:
        raise ParameterStudyError(f"{path}: {problem.strerror}") from None
    except (yaml.YAMLError, UnicodeDecodeError) as problem:
        raise ParameterStudyError(f"{path} is not YAML: {' '.join(str(problem).split())}") from None
    if not isinstance(found, dict):
        raise ParameterStudyError(f"{path}: must be a list of `entry: value`; allowed entries: {', '.join(allowed)}")
    for name in found:
        if name not in allowed:
            raise ParameterStudyError(
                f"{path}: unknown entry '{name}'; allowed: {', '.join(allowed)}"
                + parameter_file.meant(str(name), allowed)
            )
    for name in required:
        if name not in found:
            raise ParameterStudyError(f"{path}: entry '{name}' is missing")
    return found


def as_list(values: Any) -> list[Any]:
    return values if isinstance(values, list) else [values]


def parameter_value(value: Any) -> str:
    """As an OpenFOAM dictionary has it; YAML reads on and off as booleans."""
    return {True: "on", False: "off"}[value] if isinstance(value, bool) else str(value)


def safe_name(text: str) -> str:
    return re.sub(r"[^\w.+-]+", "_", text)


def with_needs(task: Task, links: tuple[tuple[str, str], ...]) -> Task:
    needs = tuple(dict.fromkeys(maker for _, maker in links))
    return dataclasses.replace(task, needs=needs, links=links)
