"""Runs one task of a parameterStudy: makes its folder, runs or resumes it, publishes its results.

The folder of a task holds, beside the copy of the case: `log` (what Allrun said), `attempts` (start and end of each,
one JSON object per line), and then `done` or `failed`. Whoever runs it holds a lock on `attempts`. """

import contextlib
import csv
import fcntl
import json
import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path
from typing import IO, Any, Iterator

from clepsydra import case_files, parameter_file, whole_files
from clepsydra.parameter_studies.plan import ParameterStudy, ParameterStudyError, Task

# What a template's outputs are called, which must not be copied with it.
OUTPUTS = ("steps", "runs", "results", "polyMesh", "meshes", "log.*", ".git*")
STOPPED = 143  # exit status of Allrun, and of a task, that SIGTERM ended with a checkpoint
BETWEEN_LOOKS = 1  # s
BETWEEN_PRUNINGS = 60  # s
MOST_ROWS = 5000  # of a published m(t), beside the last
NICENESS = "10"


def execute(parameter_study: ParameterStudy, task: Task) -> int:
    """Returns the exit status: 0 done, 1 failed, 143 stopped with a checkpoint."""
    folder = parameter_study.folder(task)
    if is_done(parameter_study, task):
        return 0
    make_folder(parameter_study, task)
    with locked(folder / "attempts") as attempts:
        drop_half_line(attempts)
        for mark in ("done", "failed"):
            (folder / mark).unlink(missing_ok=True)
        status = 0 if has_ended(parameter_study, task) else attempt(parameter_study, task, attempts)
        if status == STOPPED:
            return status
        try:
            if status != 0:
                raise RuntimeError(tail(folder / "log"))
            if task.publish:
                publish(parameter_study, task)
        except (Exception, SystemExit) as problem:  # whatever it is, the other runs go on, and status shows it
            whole_files.write(folder / "failed", f"{problem}\n")
            return 1
        whole_files.write(folder / "done", "")
    return 0


def is_done(parameter_study: ParameterStudy, task: Task) -> bool:
    """A run is not done once it is to last longer than it did, or to be another. A shared part has its name from all
    that matters for it."""
    folder, end_time = parameter_study.folder(task), parameter_study.template["steps"].get(task.part)
    return (
        (folder / "done").exists()
        and not (task.publish and begun_as_another(parameter_study, task))
        and (
            end_time is None
            or parameter_file.parameters(folder / "parameters")[end_time] >= parameter_study.end_time(task)
        )
    )


def begun_as_another(parameter_study: ParameterStudy, task: Task) -> str:
    """Why the folder of an earlier attempt is not that of this task; empty where it is, or where there is none. What
    only one of the two has does not count: the template may have more parameters by now."""
    folder = parameter_study.folder(task)
    if not folder.exists():
        return ""
    before, now = parameter_file.parameters(folder / "parameters"), parameter_study.parameters(task)
    changed = [name for name in before if name in now and before[name] != now[name] and parameter_study.matters(name)]
    # of the filling alone: what it takes from the file's parameters, and not from the run's
    changed = changed or [
        f"those of its {parameter_study.tasks[maker].part}"
        for made, maker in task.links
        if (folder / made).is_symlink() and not os.readlink(folder / made).endswith(f"/{maker}/{made}")
    ]
    if not changed:
        return ""
    return (
        f"{folder} was begun with other parameters than the parameter study's file and the template have now "
        f"({', '.join(changed)}); remove that folder to begin again, or give the run another name"
    )


def has_ended(parameter_study: ParameterStudy, task: Task) -> bool:
    """True where the last attempt came to its end, and only its results may be missing."""
    folder = parameter_study.folder(task)
    return (
        events(folder)[-1:] != []
        and events(folder)[-1].get("status") == 0
        and (folder / "parameters").read_text() == parameter_study.parameter_text(task)
    )


def attempt(parameter_study: ParameterStudy, task: Task, attempts: IO[str]) -> int:
    note(attempts, {"start": time.time(), "host": socket.gethostname(), "ranks": task.ranks})
    whole_files.write(parameter_study.folder(task) / "parameters", parameter_study.parameter_text(task))
    status = run_allrun(parameter_study, task)
    note(attempts, {"end": time.time(), "status": status})
    return status


def make_folder(parameter_study: ParameterStudy, task: Task) -> None:
    """The copy of the template; one that is there from an earlier attempt must have the same parameters, but for how
    long the steps last."""
    folder = parameter_study.folder(task)
    if folder.exists():
        problem = begun_as_another(parameter_study, task)
        if problem:
            raise SystemExit(f"parameterStudy: {problem}")
        return
    unfinished = folder.with_name(folder.name + ".unfinished")
    copy_case(parameter_study.case, unfinished)
    (unfinished / "parameters").write_text(parameter_study.parameter_text(task))
    for made, maker in task.links:
        (unfinished / made).parent.mkdir(parents=True, exist_ok=True)
        (unfinished / made).symlink_to(parameter_study.work / maker / made)
    whole_files.settle_tree(unfinished)
    unfinished.rename(folder)


def copy_case(case: Path, folder: Path) -> None:
    """A case without what runs have left in it. Its programs become links: they find the repository's scripts from
    where they really are."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(case, folder, ignore=shutil.ignore_patterns(*OUTPUTS))
    for program in case.iterdir():
        if program.is_file() and os.access(program, os.X_OK):
            (folder / program.name).unlink()
            (folder / program.name).symlink_to(program.resolve())


@contextlib.contextmanager
def locked(path: Path) -> Iterator[IO[str]]:
    with open(path, "a+") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise SystemExit(f"parameterStudy: {path.parent} is being run already") from None
        yield file


def note(attempts: IO[str], event: dict[str, Any]) -> None:
    attempts.write(json.dumps(event) + "\n")
    attempts.flush()
    os.fsync(attempts.fileno())


def drop_half_line(attempts: IO[str]) -> None:
    """What a kill, or a full disk, has left at the end."""
    attempts.seek(0)
    text = attempts.read()
    whole = text.rfind("\n") + 1
    if whole < len(text):
        print(f"parameterStudy: {attempts.name}: dropped half a line at its end, which a kill has left", flush=True)
        attempts.truncate(len(text[:whole].encode()))
    attempts.seek(0, os.SEEK_END)


def run_allrun(parameter_study: ParameterStudy, task: Task) -> int:
    folder = parameter_study.folder(task)
    program = parameter_study.work / "program"
    libraries = [str(program / "lib"), *filter(None, [os.environ.get("LD_LIBRARY_PATH")])]
    environment = os.environ | {"CLEPSYDRA_BUILD": str(program), "LD_LIBRARY_PATH": ":".join(libraries)}
    with open(folder / "log", "a") as log:
        # a session of its own: an interrupt from the terminal reaches this program only, which asks for a checkpoint
        process = subprocess.Popen(
            ["nice", "-n", NICENESS, "./Allrun", "-np", str(task.ranks), task.part],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    on_stop(lambda *_: process.send_signal(signal.SIGTERM))
    next_pruning = time.time() + BETWEEN_PRUNINGS
    while process.poll() is None:
        time.sleep(BETWEEN_LOOKS)
        if time.time() > next_pruning:
            prune(parameter_study, task)
            next_pruning = time.time() + BETWEEN_PRUNINGS
    prune(parameter_study, task)
    return process.returncode


def on_stop(handler: Any) -> None:
    """Calls it on SIGTERM, Ctrl-C and the end of a terminal; what nohup has switched off stays so."""
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, handler)


def prune(parameter_study: ParameterStudy, task: Task) -> None:
    """Removes the older fields and checkpoints, where the parameter study says so."""
    step = step_folder(parameter_study, task)
    if parameter_study.keep_times is None or not (step / "checkpoints").is_dir():
        return
    complete = sorted(
        (marker.parent for marker in (step / "checkpoints").glob("*/complete")),
        key=lambda checkpoint: float(checkpoint.name),
    )
    for checkpoint in complete[: -parameter_study.keep_times]:
        for part in [step, *step.glob("processor*")]:
            shutil.rmtree(part / checkpoint.name, ignore_errors=True)
        shutil.rmtree(checkpoint)


def step_folder(parameter_study: ParameterStudy, task: Task) -> Path:
    return parameter_study.folder(task) / "steps" / task.part


def tail(path: Path, lines: int = 25) -> str:
    return "\n".join(path.read_text(errors="replace").splitlines()[-lines:]) + "\n"


# --- results -------------------------------------------------------------------------------------


def publish(parameter_study: ParameterStudy, task: Task) -> None:
    """m(t) as CSV, and JSON of what went in, what came out and what it cost."""
    parameter_study.results.mkdir(parents=True, exist_ok=True)
    step = step_folder(parameter_study, task)
    columns = case_files.columns(step, "massInHopper")
    last = columns.shape[1] - 1
    rows = columns.T[[*range(0, last, last // MOST_ROWS + 1), last]]
    with whole_files.replacing(parameter_study.results / f"{task.publish}.csv") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["time [s]", "mass [kg]", "particles [-]"])
        table.writerows((f"{t:.6g}", f"{m:.7g}", int(particles)) for t, m, particles, *_ in rows)

    parameters = parameter_study.parameters(task)
    text = subprocess.run(
        [*parameter_study.template["summary"], task.part],
        cwd=parameter_study.folder(task),
        stdout=subprocess.PIPE,
        check=True,
    ).stdout
    record = {
        "parameterStudy": parameter_study.path.stem,
        "run": task.publish,
        "entry": task.entry,
        "step": task.part,
        "seed": parameters[parameter_study.template["seed"]],
        "parameters": parameters,
        "packing": packing(parameter_study, task),
        "code": code_versions(step / "log.pimpleDemFoam"),
        "cost": cost(parameter_study, task),
        "summary": json.loads(text),
    }
    whole_files.write(parameter_study.results / f"{task.publish}.json", json.dumps(record, indent=2) + "\n")


def packing(parameter_study: ParameterStudy, task: Task) -> dict[str, Any]:
    """Which filling a run began from, and where its parameters differ from the run's."""
    filling = next(parameter_study.tasks[name] for name in task.needs if parameter_study.tasks[name].part == "filling")
    own, filled = parameter_study.parameters(task), parameter_study.parameters(filling)
    return {"name": filling.name, "otherParameters": {name: filled[name] for name in own if own[name] != filled[name]}}


def code_versions(log: Any) -> list[Any]:
    """What the solver says of itself, once for each version that took part."""
    with open(log, errors="replace") as lines:
        return list(dict.fromkeys(line.strip() for line in lines if line.startswith("    Clepsydra ")))


def events(folder: Path) -> list[dict[str, Any]]:
    """Starts and ends of attempts; half a line at the end, which a kill leaves, is not counted."""
    path = folder / "attempts"
    if not path.exists():
        return []
    found: list[Any] = []
    for number, line in enumerate(path.read_text(errors="replace").split("\n")[:-1], 1):
        try:
            event = json.loads(line)
            # a start has a time and a number of ranks; an end, a time and a status, and comes after a start
            numbers = (
                (event["start"], event["ranks"])
                if "start" in event
                else (event["end"], event["status"], found[-1]["start"])
            )
            if not all(isinstance(one, (int, float)) for one in numbers):
                raise ValueError
        except (ValueError, KeyError, TypeError, IndexError, AttributeError):
            raise ParameterStudyError(
                f"{path}:{number}: {line[:60]!r} is no start or end of an attempt, as JSON; remove that line: "
                "only the time that was spent gets lost"
            ) from None
        found.append(event)
    return found


def attempts_of(folder: Path) -> list[list[Any]]:
    """[start, end, ranks] of each; an attempt that was killed ended when its log was last written."""
    found = []
    for event in events(folder):
        if "start" in event:
            found.append([event["start"], None, event["ranks"]])
        else:
            found[-1][1] = event["end"]
    for number, (_, end, _) in enumerate(found):
        if end is None:
            following = found[number + 1][0] if number + 1 < len(found) else time.time()
            found[number][1] = min(last_written(folder), following)
    return found


def last_written(folder: Path) -> float:
    return max(path.stat().st_mtime for path in [folder / "attempts", *folder.glob("steps/*/log.pimpleDemFoam")])


def wall_seconds(folder: Path) -> float:
    return sum(max(0, end - start) for start, end, _ in attempts_of(folder))


def cost(parameter_study: ParameterStudy, task: Task) -> dict[str, Any]:
    attempts = attempts_of(parameter_study.folder(task))
    return {
        "wallSeconds": round(wall_seconds(parameter_study.folder(task)), 1),
        "attempts": len(attempts),
        "coreHours": round(sum((end - start) * ranks for start, end, ranks in attempts) / 3600, 4),
        "ranks": task.ranks,
        "host": socket.gethostname(),
        "processor": processor_name(),
        "loadAverage": round(os.getloadavg()[2], 2),
        "finished": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
    }


def processor_name() -> str:
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return "unknown"
