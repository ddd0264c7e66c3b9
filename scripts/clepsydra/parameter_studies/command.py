#!/usr/bin/python3
"""Runs a list of cases: a sweep, several packings, dry and submerged. May be interrupted at any time and run again.

usage: parameterStudy run FILE [--cores N] [--only ENTRY ...] [--missing] [--executor local|slurm] [-- SBATCH OPTIONS]
       parameterStudy check FILE [--executor slurm]   whether it is right, and how long each run takes; makes nothing
       parameterStudy status FILE [--missing]   what is done, what is left, when it will end
       parameterStudy stop FILE         asks all that runs here to write a checkpoint and end
       parameterStudy archive FILE      moves the results into one file beside the folder; what reads results reads both
       parameterStudy task FILE NAME    runs one task here (the executors call this)

FILE is YAML; docs/howTo/parameterStudies.md describes it. Paths in it are relative to its folder.
"""

import argparse
import contextlib
import fcntl
import os
import shutil
import signal
import sys
from pathlib import Path
from typing import Iterator

from clepsydra import environment, parameter_study_results, whole_files
from clepsydra.case_rules import Findings
from clepsydra.parameter_studies import executors, status, task
from clepsydra.parameter_studies.plan import ParameterStudy, ParameterStudyError


def main() -> int:
    options = read_options()
    try:
        parameter_study = ParameterStudy(
            options.file, getattr(options, "only", None), getattr(options, "missing", False)
        )
        return options.command(parameter_study, options)
    except ParameterStudyError as problem:
        print(f"parameterStudy: {problem}", file=sys.stderr)
        return 2
    except shutil.Error as problem:  # of copytree: (source, target, why) of each
        _, target, why = problem.args[0][0]
        print(f"parameterStudy: {target}: {why}", file=sys.stderr)
        return 2
    except OSError as problem:  # a full disk, a folder that may not be written
        print(f"parameterStudy: {problem.filename or options.file}: {problem.strerror}", file=sys.stderr)
        return 2


def read_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        usage=(__doc__ or "").split("usage: ")[1].split("\n\n")[0], description=(__doc__ or "").split("\n")[0]
    )
    commands = parser.add_subparsers(required=True)
    known = {"run": run, "check": check, "status": show_status, "stop": stop, "archive": archive, "task": run_task}
    for name, command in known.items():
        its = commands.add_parser(name, prog=f"parameterStudy {name}")
        its.set_defaults(command=command)
        its.add_argument("file", metavar="FILE")
        if name in ("run", "status"):
            its.add_argument("--cores", type=positive, default=len(os.sched_getaffinity(0)))
            its.add_argument("--missing", action="store_true", help="only the runs that have no results yet")
        if name == "run":
            its.add_argument("--only", metavar="ENTRY", nargs="+", help="of the file's runs")
        if name in ("run", "check"):
            its.add_argument("--executor", choices=("local", "slurm"), default="local")
        if name == "task":
            its.add_argument("name", metavar="NAME")
    arguments, _, sbatch = split_at(sys.argv[1:], "--")
    options = parser.parse_args(arguments)
    options.sbatch = sbatch
    return options


def split_at(words: list[str], mark: str) -> tuple[list[str], list[str], list[str]]:
    """What stands before the mark, the mark if it is there, and what stands after it."""
    at = words.index(mark) if mark in words else len(words)
    return words[:at], words[at : at + 1], words[at + 1 :]


def positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("must be above 0")
    return number


def run(parameter_study: ParameterStudy, options: argparse.Namespace) -> int:
    if not parameter_study.tasks:
        print("parameterStudy: every run has its results")
        return 0
    require_same_parameters(parameter_study)
    say_outdated(parameter_study)
    warn(parameter_study.check(options.executor))
    copy_program(parameter_study)
    copy_template(parameter_study)
    if options.executor == "slurm":
        jobs = executors.slurm(parameter_study, options.sbatch)
        print(
            f"parameterStudy: submitted as jobs {', '.join(jobs)}; `{sys.argv[0]} status {options.file}` shows how far"
            " they are"
            if jobs
            else "parameterStudy: all is done"
        )
        return 0
    with sole_runner(parameter_study):
        stopped_by = executors.local(parameter_study, options.cores)
    for name, tail in status.failures(parameter_study):
        print(
            f"\nparameterStudy: {name} failed; the end of {parameter_study.work / name}/log:\n{tail}", file=sys.stderr
        )
    found = status.states(parameter_study)
    print(
        "parameterStudy: "
        + status.headline(parameter_study, found, status.remaining_seconds(parameter_study, found), options.cores)
    )
    if stopped_by:
        print("parameterStudy: stopped; the same command goes on")
        return 128 + stopped_by
    return 0 if set(found.values()) == {"done"} else 1


def check(parameter_study: ParameterStudy, options: argparse.Namespace) -> int:
    known = parameter_study.check(options.executor)
    warn(known)
    for name, found in known.items():
        if parameter_study.tasks[name].publish:
            print("\n  ".join([name, *found.facts]))
    print(f"parameterStudy: {len(parameter_study.tasks)} tasks, no mistake found")
    return 0


def require_same_parameters(parameter_study: ParameterStudy) -> None:
    problems = [
        task.begun_as_another(parameter_study, its)
        for its in parameter_study.tasks.values()
        if not task.is_done(parameter_study, its)
    ]
    if any(problems):
        raise ParameterStudyError("\n".join(filter(None, problems)))


def say_outdated(parameter_study: ParameterStudy) -> None:
    for path, names in parameter_study.outdated.items():
        print(f"parameterStudy: {path} is of other parameters ({', '.join(names)}): its run is one of the missing")


def warn(known: dict[str, Findings]) -> None:
    for warning in dict.fromkeys(f"{warning}" for found in known.values() for warning in found.warnings):
        print(f"parameterStudy: {warning} (a warning)", file=sys.stderr)


def copy_program(parameter_study: ParameterStudy) -> None:
    """The whole parameter study runs one build, also where the repository is built again meanwhile."""
    target = parameter_study.work / "program"
    if target.exists():
        return
    program = environment.program("pimpleDemFoam")
    if not program.exists():
        raise ParameterStudyError(f"there is no {program}; run scripts/setup")
    build = program.parent.parent
    unfinished = target.with_name("program.unfinished")
    shutil.rmtree(unfinished, ignore_errors=True)
    (unfinished / "bin").mkdir(parents=True)
    shutil.copy2(build / "bin" / "pimpleDemFoam", unfinished / "bin")
    shutil.copytree(build / "lib", unfinished / "lib", ignore=no_libraries)
    whole_files.settle_tree(unfinished)
    unfinished.rename(target)


def no_libraries(folder: str, names: list[str]) -> list[str]:
    return [name for name in names if ".so" not in name and not Path(folder, name).is_dir()]


def copy_template(parameter_study: ParameterStudy) -> None:
    """Nor does it matter that the case is edited meanwhile: all runs are of the case as it was at the start."""
    if parameter_study.frozen_case.exists():
        return
    unfinished = parameter_study.frozen_case.with_name("case.unfinished")
    task.copy_case(parameter_study.case, unfinished)
    whole_files.settle_tree(unfinished)
    unfinished.rename(parameter_study.frozen_case)


@contextlib.contextmanager
def sole_runner(parameter_study: ParameterStudy) -> Iterator[None]:
    """Only one at a time; `stop` finds it through this file."""
    with open(parameter_study.work / "runner", "a+") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ParameterStudyError(
                f"{parameter_study.work} is being run already; `parameterStudy status` shows how far it is"
            ) from None
        file.truncate(0)
        file.write(f"{os.getpid()}\n")
        file.flush()
        yield


def show_status(parameter_study: ParameterStudy, options: argparse.Namespace) -> int:
    say_outdated(parameter_study)
    print(
        "\n".join(status.table(parameter_study, options.cores))
        if parameter_study.tasks
        else "parameterStudy: every run has its results"
    )
    for name, tail in status.failures(parameter_study):
        print(f"\n{name} failed; the end of {parameter_study.work / name}/log:\n{tail}")
    return 0


def stop(parameter_study: ParameterStudy, _: argparse.Namespace) -> int:
    runner = parameter_study.work / "runner"
    if not status.is_locked(runner):
        print("parameterStudy: nothing runs here (jobs of Slurm are stopped by scancel)")
        return 1
    try:
        os.kill(int(runner.read_text()), signal.SIGTERM)
    except (ValueError, ProcessLookupError):
        raise ParameterStudyError(
            f"{runner} does not say which process runs here; send SIGTERM to `parameterStudy run` yourself"
        ) from None
    print("parameterStudy: asked to stop; each run writes a checkpoint first")
    return 0


def archive(parameter_study: ParameterStudy, _: argparse.Namespace) -> int:
    files = parameter_study_results.archive(parameter_study.results)
    print(f"parameterStudy: {files} files in {parameter_study_results.archive_of(parameter_study.results)}")
    return 0


def run_task(parameter_study: ParameterStudy, options: argparse.Namespace) -> int:
    if options.name not in parameter_study.tasks:
        raise ParameterStudyError(f"no task '{options.name}'; there are: {', '.join(parameter_study.tasks)}")
    its = parameter_study.tasks[options.name]
    for need in its.needs:
        if not task.is_done(parameter_study, parameter_study.tasks[need]):
            raise ParameterStudyError(f"{options.name} needs {need}, which is not done")
    result = task.execute(parameter_study, its)
    found = status.states(parameter_study)
    word = {0: "done", task.STOPPED: "stopped"}.get(result, "FAILED")
    print(
        f"parameterStudy: {options.name} {word}, {status.duration(status.spent(parameter_study, its))}; "
        + status.headline(
            parameter_study, found, status.remaining_seconds(parameter_study, found), len(os.sched_getaffinity(0))
        ),
        flush=True,
    )
    return result


if __name__ == "__main__":
    sys.exit(main())
