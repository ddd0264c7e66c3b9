"""Runs one task of a campaign: makes its folder, runs or resumes it, publishes its results.

The folder of a task holds, beside the copy of the case: `log` (what Allrun said), `attempts` (start and end of each, one
JSON object per line), and then `done` or `failed`. Whoever runs it holds a lock on `attempts`.
"""

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

import caseFiles
import parameterFile
import wholeFiles
from campaigns.plan import CampaignError

# What a template's outputs are called, which must not be copied with it.
OUTPUTS = ("stages", "runs", "results", "polyMesh", "meshes", "log.*", ".git*")
STOPPED = 143           # exit status of Allrun, and of a task, that SIGTERM ended with a checkpoint
BETWEEN_LOOKS = 1       # s
BETWEEN_PRUNINGS = 60   # s
MOST_ROWS = 5000        # of a published m(t), beside the last
NICENESS = "10"


def execute(campaign, task):
    """Returns the exit status: 0 done, 1 failed, 143 stopped with a checkpoint."""
    folder = campaign.folder(task)
    if isDone(campaign, task):
        return 0
    makeFolder(campaign, task)
    with locked(folder / "attempts") as attempts:
        dropHalfLine(attempts)
        for mark in ("done", "failed"):
            (folder / mark).unlink(missing_ok=True)
        status = 0 if hasEnded(campaign, task) else attempt(campaign, task, attempts)
        if status == STOPPED:
            return status
        try:
            if status != 0:
                raise RuntimeError(tail(folder / "log"))
            if task.publish:
                publish(campaign, task)
        except (Exception, SystemExit) as problem:  # whatever it is, the other runs go on, and status shows it
            wholeFiles.write(folder / "failed", f"{problem}\n")
            return 1
        wholeFiles.write(folder / "done", "")
    return 0


def isDone(campaign, task):
    """A run is not done once it is to last longer than it did."""
    folder, endTime = campaign.folder(task), campaign.template["stages"].get(task.part)
    return (folder / "done").exists() and (
        endTime is None or parameterFile.parameters(folder / "parameters")[endTime] >= campaign.endTime(task))


def hasEnded(campaign, task):
    """True where the last attempt came to its end, and only its results may be missing."""
    folder = campaign.folder(task)
    return (events(folder)[-1:] != [] and events(folder)[-1].get("status") == 0
            and (folder / "parameters").read_text() == campaign.parameterText(task))


def attempt(campaign, task, attempts):
    note(attempts, {"start": time.time(), "host": socket.gethostname(), "ranks": task.ranks})
    wholeFiles.write(campaign.folder(task) / "parameters", campaign.parameterText(task))
    status = runAllrun(campaign, task)
    note(attempts, {"end": time.time(), "status": status})
    return status


def makeFolder(campaign, task):
    """The copy of the template; one that is there from an earlier attempt must have the same parameters, but for how long
    the stages last."""
    folder = campaign.folder(task)
    if folder.exists():
        changed = [name for name in parameterFile.changedNames(parameterFile.parameters(folder / "parameters"), campaign.parameters(task))
                   if name not in campaign.template["stages"].values()]
        if changed:
            raise SystemExit(f"campaign: {folder} was begun with other parameters than the campaign's file has now "
                             f"({', '.join(changed)}); remove that folder to begin anew, or give the run another name")
        return
    unfinished = folder.with_name(folder.name + ".unfinished")
    copyCase(campaign.case, unfinished)
    (unfinished / "parameters").write_text(campaign.parameterText(task))
    for made, maker in task.links:
        (unfinished / made).parent.mkdir(parents=True, exist_ok=True)
        (unfinished / made).symlink_to(campaign.work / maker / made)
    wholeFiles.settleTree(unfinished)
    unfinished.rename(folder)


def copyCase(case, folder):
    """A case without what runs have left in it. Its programs become links: they find the repository's scripts from where
    they really are."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(case, folder, ignore=shutil.ignore_patterns(*OUTPUTS))
    for program in case.iterdir():
        if program.is_file() and os.access(program, os.X_OK):
            (folder / program.name).unlink()
            (folder / program.name).symlink_to(program.resolve())


@contextlib.contextmanager
def locked(path):
    with open(path, "a+") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise SystemExit(f"campaign: {path.parent} is being run already") from None
        yield file


def note(attempts, event):
    attempts.write(json.dumps(event) + "\n")
    attempts.flush()
    os.fsync(attempts.fileno())


def dropHalfLine(attempts):
    """What a kill, or a full disk, has left at the end."""
    attempts.seek(0)
    text = attempts.read()
    whole = text.rfind("\n") + 1
    if whole < len(text):
        print(f"campaign: {attempts.name}: dropped half a line at its end, which a kill has left", flush=True)
        attempts.truncate(len(text[:whole].encode()))
    attempts.seek(0, os.SEEK_END)


def runAllrun(campaign, task):
    folder = campaign.folder(task)
    program = campaign.work / "program"
    libraries = [str(program / "lib"), *filter(None, [os.environ.get("LD_LIBRARY_PATH")])]
    environment = os.environ | {"CLEPSYDRA_BUILD": str(program), "LD_LIBRARY_PATH": ":".join(libraries)}
    with open(folder / "log", "a") as log:
        # a session of its own: an interrupt from the terminal reaches this program only, which asks for a checkpoint
        process = subprocess.Popen(["nice", "-n", NICENESS, "./Allrun", "-np", str(task.ranks), task.part], cwd=folder,
                                   env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                                   start_new_session=True)
    onStop(lambda *_: process.send_signal(signal.SIGTERM))
    nextPruning = time.time() + BETWEEN_PRUNINGS
    while process.poll() is None:
        time.sleep(BETWEEN_LOOKS)
        if time.time() > nextPruning:
            prune(campaign, task)
            nextPruning = time.time() + BETWEEN_PRUNINGS
    prune(campaign, task)
    return process.returncode


def onStop(handler):
    """Calls it on SIGTERM, Ctrl-C and the end of a terminal; what nohup has switched off stays so."""
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, handler)


def prune(campaign, task):
    """Removes the older fields and checkpoints, where the campaign says so."""
    stage = stageFolder(campaign, task)
    if campaign.keepTimes is None or not (stage / "checkpoints").is_dir():
        return
    complete = sorted((marker.parent for marker in (stage / "checkpoints").glob("*/complete")),
                      key=lambda checkpoint: float(checkpoint.name))
    for checkpoint in complete[:-campaign.keepTimes]:
        for part in [stage, *stage.glob("processor*")]:
            shutil.rmtree(part / checkpoint.name, ignore_errors=True)
        shutil.rmtree(checkpoint)


def stageFolder(campaign, task):
    return campaign.folder(task) / "stages" / task.part


def tail(path, lines=25):
    return "\n".join(path.read_text(errors="replace").splitlines()[-lines:]) + "\n"


# --- results -------------------------------------------------------------------------------------

def publish(campaign, task):
    """m(t) as CSV, and JSON of what went in, what came out and what it cost."""
    campaign.results.mkdir(parents=True, exist_ok=True)
    stage = stageFolder(campaign, task)
    columns = caseFiles.columns(stage, "massInHopper")
    last = columns.shape[1] - 1
    rows = columns.T[[*range(0, last, last // MOST_ROWS + 1), last]]
    with wholeFiles.replacing(campaign.results / f"{task.publish}.csv") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["time [s]", "mass [kg]", "beads [-]"])
        table.writerows((f"{t:.6g}", f"{m:.7g}", int(beads)) for t, m, beads, *_ in rows)

    parameters = campaign.parameters(task)
    text = subprocess.run([*campaign.template["summary"], task.part],
                          cwd=campaign.folder(task), stdout=subprocess.PIPE, check=True).stdout
    record = {"campaign": campaign.path.stem, "run": task.publish, "entry": task.entry, "stage": task.part,
              "seed": parameters[campaign.template["seed"]], "parameters": parameters,
              "packing": packing(campaign, task), "code": codeVersions(stage / "log.pimpleDemFoam"),
              "cost": cost(campaign, task), "summary": json.loads(text)}
    wholeFiles.write(campaign.results / f"{task.publish}.json", json.dumps(record, indent=2) + "\n")


def packing(campaign, task):
    """Which pour a run began from, and where its parameters differ from the run's."""
    pour = next(campaign.tasks[name] for name in task.needs if campaign.tasks[name].part == "pour")
    own, poured = campaign.parameters(task), campaign.parameters(pour)
    return {"name": pour.name, "otherParameters": {name: poured[name] for name in own if own[name] != poured[name]}}


def codeVersions(log):
    """What the solver says of itself, once for each version that took part."""
    with open(log, errors="replace") as lines:
        return list(dict.fromkeys(line.strip() for line in lines if line.startswith("    Clepsydra ")))


def events(folder):
    """Starts and ends of attempts; half a line at the end, which a kill leaves, is not counted."""
    path = folder / "attempts"
    if not path.exists():
        return []
    found = []
    for number, line in enumerate(path.read_text(errors="replace").split("\n")[:-1], 1):
        try:
            event = json.loads(line)
            # a start has a time and a number of ranks; an end, a time and a status, and comes after a start
            numbers = (event["start"], event["ranks"]) if "start" in event else (event["end"], event["status"], found[-1]["start"])
            if not all(isinstance(one, (int, float)) for one in numbers):
                raise ValueError
        except (ValueError, KeyError, TypeError, IndexError, AttributeError):
            raise CampaignError(f"{path}:{number}: {line[:60]!r} is no start or end of an attempt, as JSON; remove that line: "
                                "only the time that was spent gets lost") from None
        found.append(event)
    return found


def attemptsOf(folder):
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
            found[number][1] = min(lastWritten(folder), following)
    return found


def lastWritten(folder):
    return max(path.stat().st_mtime for path in [folder / "attempts", *folder.glob("stages/*/log.pimpleDemFoam")])


def wallSeconds(folder):
    return sum(max(0, end - start) for start, end, _ in attemptsOf(folder))


def cost(campaign, task):
    attempts = attemptsOf(campaign.folder(task))
    return {"wallSeconds": round(wallSeconds(campaign.folder(task)), 1), "attempts": len(attempts),
            "coreHours": round(sum((end - start) * ranks for start, end, ranks in attempts) / 3600, 4),
            "ranks": task.ranks, "host": socket.gethostname(), "processor": processorName(),
            "loadAverage": round(os.getloadavg()[2], 2), "finished": time.strftime("%Y-%m-%dT%H:%M:%S%z")}


def processorName():
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return "unknown"
