#!/usr/bin/python3
"""Writes the manual page of a program from what it says of itself, so that there is one text. """

import argparse
import subprocess
from pathlib import Path
from typing import Any


def said(program: Any, option: Any) -> str:
    return subprocess.run([program, option], check=True, capture_output=True, text=True).stdout.strip("\n")


def verbatim(text: str) -> str:
    """As it stands; roff takes a line's first dot or quote for its own, and backslashes anywhere."""
    lines = [line.rstrip().replace("\\", "\\e").replace("-", "\\-") for line in text.splitlines()]
    return "\n".join([".nf", *("\\&" + line if line[:1] in (".", "'") else line for line in lines), ".fi"])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, prefix_chars="+")
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("summary", metavar="SUMMARY")
    parser.add_argument("help", metavar="HELP_OPTION")
    parser.add_argument("file", type=Path, metavar="FILE")
    parser.add_argument(
        "more", nargs="*", metavar="OPTION HEADING", help="each OPTION is asked for, and printed below HEADING"
    )
    given = parser.parse_args()
    if len(given.more) % 2:
        parser.error("OPTION and HEADING come in pairs")
    program, summary, help, more = given.program, given.summary, given.help, given.more
    name = Path(program).name
    parts = [
        f'.TH {name.upper()} 1 "" Clepsydra',
        f".SH NAME\n{name} \\- {summary}",
        f".SH USAGE\n{verbatim(said(program, help))}",
    ]
    parts += [
        f".SH {heading.upper()}\n{verbatim(said(program, option))}" for option, heading in zip(more[::2], more[1::2])
    ]
    parts.append(".SH SEE ALSO\nThe pages in share/clepsydra, of which README.md is the first.")
    given.file.write_text("\n".join(parts) + "\n")


if __name__ == "__main__":
    main()
