"""What queues the tasks: GNU make on this machine, or Slurm. Both run `scripts/parameterStudy task FILE NAME`."""

import os
import shlex
import signal
import subprocess
import sys
from types import FrameType

from clepsydra import whole_files
from clepsydra.parameter_studies.plan import ParameterStudy, ParameterStudyError
from clepsydra.parameter_studies.task import is_done, on_stop

COMMAND = os.path.abspath(sys.argv[0])


def local(parameter_study: ParameterStudy, cores: int) -> int | None:
    """A pool of processes: make keeps `cores` of them busy, each task after those that it needs. Returns the signal
    that asked it to stop, or None."""
    slots = max(1, cores // max(task.ranks for task in parameter_study.tasks.values()))
    makefile = parameter_study.work / "Makefile"
    targets = {name: f"{name}/done" for name in parameter_study.tasks}
    # whatever marks there are: a run may have been lengthened since
    left = [targets[name] for name, task in parameter_study.tasks.items() if not is_done(parameter_study, task)]
    rules = [f"all: {' '.join(targets.values())}", f".PHONY: {' '.join(left)}"]
    for name, task in parameter_study.tasks.items():
        rules += [
            f"{targets[name]}: | {' '.join(targets[need] for need in task.needs)}",
            # exec: the signals of make must reach the task, not a shell before it
            "\t@exec " + shlex.join([COMMAND, "task", str(parameter_study.path), name]).replace("$", "$$") + " 2>&1",
        ]
    whole_files.write(makefile, "\n".join(rules) + "\n")
    # without make's own words on what failed: the tasks say it themselves
    make = subprocess.Popen(
        ["make", "--keep-going", "--silent", f"--jobs={slots}", "--file", makefile.name, "all"],
        cwd=parameter_study.work,
        stdin=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    received = []

    def stop(number: int, _: FrameType | None) -> None:
        received.append(number)
        # make hands SIGTERM on to the tasks and waits for them; a terminal's interrupt reaches it by itself
        if number != signal.SIGINT:
            make.send_signal(signal.SIGTERM)

    on_stop(stop)
    make.wait()
    return received[0] if received else None


def slurm(parameter_study: ParameterStudy, options: list[str]) -> list[str]:
    """Submits the tasks that are not done as job arrays, shared parts first. Returns the jobs' numbers."""
    levels: list[list[str]] = []
    for name, task in parameter_study.tasks.items():
        if is_done(parameter_study, task):
            continue
        level = 1 + max((number for number, others in enumerate(levels) if set(task.needs) & set(others)), default=-1)
        while len(levels) <= level:
            levels.append([])
        levels[level].append(name)
    jobs: list[str] = []
    before: list[str] = []
    for names in filter(None, levels):
        here = [
            submit(
                parameter_study,
                [name for name in names if parameter_study.tasks[name].ranks == ranks],
                ranks,
                before,
                options,
            )
            for ranks in sorted({parameter_study.tasks[name].ranks for name in names})
        ]
        jobs += here
        before = here
    return jobs


def submit(parameter_study: ParameterStudy, names: list[str], ranks: int, before: list[str], options: list[str]) -> str:
    """One job array. Its tasks find their names by the line of a list."""
    number = len(list(parameter_study.work.glob("slurm.*.list")))
    listed = parameter_study.work / f"slurm.{number}.list"
    whole_files.write(listed, "\n".join(names) + "\n")
    name = f'"$(sed -n "$SLURM_ARRAY_TASK_ID"p {shlex.quote(str(listed))})"'
    # exec: Slurm's SIGTERM, ahead of the time limit, must reach the task itself
    script = f"#!/bin/bash\nexec {shlex.join([COMMAND, 'task', str(parameter_study.path)])} {name}\n"
    command = [
        "sbatch",
        "--parsable",
        f"--job-name={parameter_study.path.stem}",
        f"--array=1-{len(names)}",
        "--nodes=1",
        f"--ntasks={ranks}",
        "--signal=B:TERM@300",
        f"--output={parameter_study.work}/slurm.%A_%a.log",
        *options,
    ]
    if before:
        # after any end of the others: a task whose needs are not done says so by itself
        command.append("--dependency=afterany:" + ":".join(before))
    try:
        answer = subprocess.run(command, input=script, text=True, stdout=subprocess.PIPE, check=True)
    except FileNotFoundError:
        raise ParameterStudyError("there is no sbatch here: is Slurm installed?") from None
    except subprocess.CalledProcessError:
        raise ParameterStudyError("sbatch refused the job; see above") from None
    return answer.stdout.strip().split(";")[0]
