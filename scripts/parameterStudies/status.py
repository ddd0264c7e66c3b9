"""What of a parameter study is done, what is left, and when it will end."""

import fcntl
import time
from collections import Counter
from pathlib import Path

from clepsydra import case_files
from parameterStudies.task import attemptsOf, isDone, stepFolder, wallSeconds

ORDER = ("done", "running", "stopped", "waiting", "blocked", "failed")


def states(parameterStudy):
    """State of every task, by name."""
    found = {}
    for name, task in parameterStudy.tasks.items():  # needs come before those that need them
        folder = parameterStudy.folder(task)
        if isDone(parameterStudy, task):
            found[name] = "done"
        elif isLocked(folder / "attempts"):
            found[name] = "running"
        elif (folder / "failed").exists():
            found[name] = "failed"
        elif any(found[need] in ("failed", "blocked") for need in task.needs):
            found[name] = "blocked"
        else:
            found[name] = "stopped" if (folder / "attempts").exists() else "waiting"
    return found


def isLocked(path):
    try:
        with open(path) as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except BlockingIOError:
        return True
    return False


def progress(parameterStudy, task):
    """Simulated time, mass now and share done (guessed from the present rate); None before the first row."""
    end = parameterStudy.endTime(task)
    try:
        now, mass, _, rate = case_files.columns(stepFolder(parameterStudy, task), "massInHopper")[:, -1]
    except (SystemExit, OSError, ValueError):
        return None
    left = end - now
    if task.publish and rate > 0:
        left = min(left, mass / rate)
    return {"time": now, "mass": mass, "share": now / (now + left) if now > 0 else 0.0}


def remainingSeconds(parameterStudy, found):
    """Of wall time for each task that is not done, as far as others like it tell; None where nothing does."""
    whole = {}
    for name, task in parameterStudy.tasks.items():
        spent = wallSeconds(parameterStudy.folder(task)) if attemptsOf(parameterStudy.folder(task)) else 0
        if found[name] == "done":
            whole[name] = spent
        elif (
            task.part in parameterStudy.template["steps"]
            and (now := progress(parameterStudy, task))
            and now["share"] > 0.02
        ):
            whole[name] = spent / now["share"]
    left = {}
    for name, task in parameterStudy.tasks.items():
        if found[name] == "done":
            continue
        alike = [
            whole[other] for other, its in parameterStudy.tasks.items() if other in whole and its.part == task.part
        ]
        nearer = [
            whole[other]
            for other, its in parameterStudy.tasks.items()
            if other in whole and (its.part, its.entry) == (task.part, task.entry)
        ]
        spent = wallSeconds(parameterStudy.folder(task)) if attemptsOf(parameterStudy.folder(task)) else 0
        guesses = [whole[name]] if name in whole else nearer or alike
        left[name] = max(0, sum(guesses) / len(guesses) - spent) if guesses else None
    return left


def table(parameterStudy, cores):
    """Lines of text."""
    found = states(parameterStudy)
    left = remainingSeconds(parameterStudy, found)
    rows = [("task", "state", "simulated", "in the hopper", "spent", "left")]
    for name, task in sorted(parameterStudy.tasks.items(), key=lambda item: ORDER.index(found[item[0]])):
        now = progress(parameterStudy, task) if parameterStudy.endTime(task) else None
        rows.append(
            (
                name,
                found[name],
                f"{now['time']:.2f} of {parameterStudy.endTime(task):g} s" if now else "-",
                f"{1e3 * now['mass']:.1f} g" if now else "-",
                duration(spent(parameterStudy, task)),
                "" if found[name] == "done" else duration(left[name]),
            )
        )
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
    return lines + ["", headline(parameterStudy, found, left, cores)]


def headline(parameterStudy, found, left, cores):
    counts = Counter(found.values())
    parts = [f"{counts[state]} {state}" for state in ORDER if counts[state]]
    counted = {name: seconds for name, seconds in left.items() if found[name] not in ("failed", "blocked")}
    known = {name: seconds for name, seconds in counted.items() if seconds is not None}
    if counted and not known:
        parts.append("too early to say when it ends")
    elif counted:
        work = sum(seconds * parameterStudy.tasks[name].ranks for name, seconds in known.items())
        seconds = max(work / cores, max(known.values()))
        unknown = len(counted) - len(known)
        at = time.strftime("%a %H:%M", time.localtime(time.time() + seconds))
        parts.append(
            f"{'not before' if unknown else 'ends about'} {at} ({duration(seconds)} on {cores} cores"
            + (f"; nothing known yet of {unknown} tasks)" if unknown else ")")
        )
    return ", ".join(parts)


def spent(parameterStudy, task):
    return wallSeconds(parameterStudy.folder(task)) if attemptsOf(parameterStudy.folder(task)) else None


def duration(seconds):
    if seconds is None:
        return "-"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def failures(parameterStudy):
    """Name and log's tail of what failed."""
    return [
        (name, Path(parameterStudy.folder(parameterStudy.tasks[name]), "failed").read_text())
        for name, state in states(parameterStudy).items()
        if state == "failed"
    ]
