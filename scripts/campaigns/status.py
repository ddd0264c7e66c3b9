"""What of a campaign is done, what is left, and when it will end."""

import fcntl
import time
from collections import Counter
from pathlib import Path

import caseFiles
from campaigns.task import attemptsOf, isDone, stageFolder, wallSeconds

ORDER = ("done", "running", "stopped", "waiting", "blocked", "failed")


def states(campaign):
    """State of every task, by name."""
    found = {}
    for name, task in campaign.tasks.items():     # needs come before those that need them
        folder = campaign.folder(task)
        if isDone(campaign, task):
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


def progress(campaign, task):
    """Simulated time, mass now and share done (guessed from the present rate); None before the first row."""
    end = campaign.endTime(task)
    try:
        now, mass, _, rate = caseFiles.columns(stageFolder(campaign, task), "massInHopper")[:, -1]
    except (SystemExit, OSError, ValueError):
        return None
    left = end - now
    if task.publish and rate > 0:
        left = min(left, mass / rate)
    return {"time": now, "mass": mass, "share": now / (now + left) if now > 0 else 0.0}


def remainingSeconds(campaign, found):
    """Of wall time for each task that is not done, as far as others like it tell; None where nothing does."""
    whole = {}
    for name, task in campaign.tasks.items():
        spent = wallSeconds(campaign.folder(task)) if attemptsOf(campaign.folder(task)) else 0
        if found[name] == "done":
            whole[name] = spent
        elif task.part in campaign.template["stages"] and (now := progress(campaign, task)) and now["share"] > 0.02:
            whole[name] = spent / now["share"]
    left = {}
    for name, task in campaign.tasks.items():
        if found[name] == "done":
            continue
        alike = [whole[other] for other, its in campaign.tasks.items() if other in whole and its.part == task.part]
        nearer = [whole[other] for other, its in campaign.tasks.items()
                  if other in whole and (its.part, its.entry) == (task.part, task.entry)]
        spent = wallSeconds(campaign.folder(task)) if attemptsOf(campaign.folder(task)) else 0
        guesses = [whole[name]] if name in whole else nearer or alike
        left[name] = max(0, sum(guesses) / len(guesses) - spent) if guesses else None
    return left


def table(campaign, cores):
    """Lines of text."""
    found = states(campaign)
    left = remainingSeconds(campaign, found)
    rows = [("task", "state", "simulated", "in the hopper", "spent", "left")]
    for name, task in sorted(campaign.tasks.items(), key=lambda item: ORDER.index(found[item[0]])):
        now = progress(campaign, task) if campaign.endTime(task) else None
        rows.append((name, found[name], f"{now['time']:.2f} of {campaign.endTime(task):g} s" if now else "-",
                     f"{1e3 * now['mass']:.1f} g" if now else "-", duration(spent(campaign, task)),
                     "" if found[name] == "done" else duration(left[name])))
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
    return lines + ["", headline(campaign, found, left, cores)]


def headline(campaign, found, left, cores):
    counts = Counter(found.values())
    parts = [f"{counts[state]} {state}" for state in ORDER if counts[state]]
    counted = {name: seconds for name, seconds in left.items() if found[name] not in ("failed", "blocked")}
    known = {name: seconds for name, seconds in counted.items() if seconds is not None}
    if counted and not known:
        parts.append("too early to say when it ends")
    elif counted:
        work = sum(seconds * campaign.tasks[name].ranks for name, seconds in known.items())
        seconds = max(work / cores, max(known.values()))
        unknown = len(counted) - len(known)
        at = time.strftime("%a %H:%M", time.localtime(time.time() + seconds))
        parts.append(f"{'not before' if unknown else 'ends about'} {at} ({duration(seconds)} on {cores} cores"
                     + (f"; nothing known yet of {unknown} tasks)" if unknown else ")"))
    return ", ".join(parts)


def spent(campaign, task):
    return wallSeconds(campaign.folder(task)) if attemptsOf(campaign.folder(task)) else None


def duration(seconds):
    if seconds is None:
        return "-"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def failures(campaign):
    """Name and log's tail of what failed."""
    return [(name, Path(campaign.folder(campaign.tasks[name]), "failed").read_text())
            for name, state in states(campaign).items() if state == "failed"]
