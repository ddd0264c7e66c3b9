"""What of a parameter study is done, what is left, and when it will end."""

import fcntl
import time
from collections import Counter
from pathlib import Path
from typing import Any

from clepsydra import case_files
from clepsydra.parameter_studies.plan import ParameterStudy, Task
from clepsydra.parameter_studies.task import attempts_of, is_done, step_folder, wall_seconds

ORDER = ("done", "running", "stopped", "waiting", "blocked", "failed")


def states(parameter_study: ParameterStudy) -> dict[str, str]:
    """State of every task, by name."""
    found = {}
    for name, task in parameter_study.tasks.items():  # needs come before those that need them
        folder = parameter_study.folder(task)
        if is_done(parameter_study, task):
            found[name] = "done"
        elif is_locked(folder / "attempts"):
            found[name] = "running"
        elif (folder / "failed").exists():
            found[name] = "failed"
        elif any(found[need] in ("failed", "blocked") for need in task.needs):
            found[name] = "blocked"
        else:
            found[name] = "stopped" if (folder / "attempts").exists() else "waiting"
    return found


def is_locked(path: Path) -> bool:
    try:
        with open(path) as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except BlockingIOError:
        return True
    return False


def progress(parameter_study: ParameterStudy, task: Task) -> dict[str, Any] | None:
    """Simulated time, mass now and share done (guessed from the present rate); None before the first row."""
    end = parameter_study.end_time(task)
    try:
        now, mass, _, rate = case_files.columns(step_folder(parameter_study, task), "massInHopper")[:, -1]
    except (SystemExit, OSError, ValueError):
        return None
    left = end - now
    if task.publish and rate > 0:
        left = min(left, mass / rate)
    return {"time": now, "mass": mass, "share": now / (now + left) if now > 0 else 0.0}


def remaining_seconds(parameter_study: ParameterStudy, found: dict[str, str]) -> dict[str, float | None]:
    """Of wall time for each task that is not done, as far as others like it tell; None where nothing does."""
    whole = {}
    for name, task in parameter_study.tasks.items():
        spent = wall_seconds(parameter_study.folder(task)) if attempts_of(parameter_study.folder(task)) else 0
        if found[name] == "done":
            whole[name] = spent
        elif (
            task.part in parameter_study.template["steps"]
            and (now := progress(parameter_study, task))
            and now["share"] > 0.02
        ):
            whole[name] = spent / now["share"]
    left = {}
    for name, task in parameter_study.tasks.items():
        if found[name] == "done":
            continue
        alike = [
            whole[other] for other, its in parameter_study.tasks.items() if other in whole and its.part == task.part
        ]
        nearer = [
            whole[other]
            for other, its in parameter_study.tasks.items()
            if other in whole and (its.part, its.entry) == (task.part, task.entry)
        ]
        spent = wall_seconds(parameter_study.folder(task)) if attempts_of(parameter_study.folder(task)) else 0
        guesses = [whole[name]] if name in whole else nearer or alike
        left[name] = max(0, sum(guesses) / len(guesses) - spent) if guesses else None
    return left


def table(parameter_study: ParameterStudy, cores: int) -> list[str]:
    """Lines of text."""
    found = states(parameter_study)
    left = remaining_seconds(parameter_study, found)
    rows = [("task", "state", "simulated", "in the hopper", "spent", "left")]
    for name, task in sorted(parameter_study.tasks.items(), key=lambda item: ORDER.index(found[item[0]])):
        now = progress(parameter_study, task) if parameter_study.end_time(task) else None
        rows.append(
            (
                name,
                found[name],
                f"{now['time']:.2f} of {parameter_study.end_time(task):g} s" if now else "-",
                f"{1e3 * now['mass']:.1f} g" if now else "-",
                duration(spent(parameter_study, task)),
                "" if found[name] == "done" else duration(left[name]),
            )
        )
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
    return lines + ["", headline(parameter_study, found, left, cores)]


def headline(parameter_study: ParameterStudy, found: dict[str, str], left: dict[str, float | None], cores: int) -> str:
    counts = Counter(found.values())
    parts = [f"{counts[state]} {state}" for state in ORDER if counts[state]]
    counted = {name: seconds for name, seconds in left.items() if found[name] not in ("failed", "blocked")}
    known = {name: seconds for name, seconds in counted.items() if seconds is not None}
    if counted and not known:
        parts.append("too early to say when it ends")
    elif counted:
        work = sum(seconds * parameter_study.tasks[name].ranks for name, seconds in known.items())
        seconds = max(work / cores, max(known.values()))
        unknown = len(counted) - len(known)
        at = time.strftime("%a %H:%M", time.localtime(time.time() + seconds))
        parts.append(
            f"{'not before' if unknown else 'ends about'} {at} ({duration(seconds)} on {cores} cores"
            + (f"; nothing known yet of {unknown} tasks)" if unknown else ")")
        )
    return ", ".join(parts)


def spent(parameter_study: ParameterStudy, task: Task) -> float | None:
    return wall_seconds(parameter_study.folder(task)) if attempts_of(parameter_study.folder(task)) else None


def duration(seconds: float | None) -> str:
    if seconds is None:
        return "-"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def failures(parameter_study: ParameterStudy) -> list[tuple[str, str]]:
    """Name and log's tail of what failed."""
    return [
        (name, Path(parameter_study.folder(parameter_study.tasks[name]), "failed").read_text())
        for name, state in states(parameter_study).items()
        if state == "failed"
    ]
