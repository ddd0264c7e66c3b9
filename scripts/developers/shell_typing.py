"""Types lines into one shell, as somebody does who reads a page, and times each."""

import os
import shlex
import subprocess
from typing import IO, Any, Iterator

# Each line by eval in the very shell, so that `cd` and what was sourced hold for the next; its times go to the pipe.
SHELL = r"""
report=$1; cd "$2" || exit
typed()
{
    local began=$EPOCHREALTIME status
    eval "$2" 2>&1 9>&- <<< "$3"
    status=$?
    echo "$1 $began $EPOCHREALTIME $status" >&9
}
exec 9>&"$report"
"""


def type_lines(enter: list[str], folder: Any, lines: Any, log: IO[str]) -> Iterator[Any]:
    """Yields (line, seconds, ok) as they come.

    enter: the words before `bash`, such as those that lead into another root; lines: dictionaries with `command`, and
    where wanted `in`
    (a folder to type it in), `before` (what is typed first and not timed), `answer` (what is typed when it asks),
    `left` (not typed).
    """
    receives, sends = os.pipe()
    script = SHELL + "\n".join(call(number, line) for number, line in enumerate(lines) if "left" not in line)
    with (
        subprocess.Popen(
            [*enter, "bash", "-c", script, "bash", str(sends), folder],
            pass_fds=[sends],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        ) as shell,
        os.fdopen(receives) as reports,
    ):
        os.close(sends)
        for number, line in enumerate(lines):
            if "left" in line:
                yield line, 0.0, True
                continue
            words = reports.readline().split()
            if not words or int(words[0]) != number:
                # the shell itself has ended, by `exit` or for want of the root
                yield line, 0.0, False
                continue
            yield line, float(words[2]) - float(words[1]), words[3] == "0"
        shell.wait()


def call(number: int, line: dict[str, Any]) -> str:
    steps = [f"echo {shlex.quote('>>> ' + line['command'])}"]
    if "in" in line:
        steps.append(f"back=$PWD; cd {shlex.quote(line['in'])}")
    if "before" in line:
        steps.append(f"eval {shlex.quote(line['before'])} < /dev/null")
    steps.append(f"typed {number} {shlex.quote(line['command'])} {shlex.quote(line.get('answer', ''))}")
    if "in" in line:
        steps.append('cd "$back"')
    return "\n".join(steps)
