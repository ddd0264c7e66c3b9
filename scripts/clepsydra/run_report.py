#!/usr/bin/python3
"""The report of a run as one page that needs no other file: observables, conservation checks, computing time, settings,
warnings.

Usage: runReport CASE FILE.html        CASE has run or is running: everything is taken from its log and the files it
writes
"""

import argparse
import html
import io
import re
from pathlib import Path
from typing import Any, Iterable, Iterator, Sequence

from clepsydra import case_files, flow, flow_drawing, picture_style, whole_files
from clepsydra.picture_style import pyplot

# What the conservation check's summary says, in words. Numbers count over all parts of a run that was resumed, errors
# are the largest.
COUNTED = {
    "particlesInserted": "particles inserted",
    "particlesLeft": "particles left through outlets",
    "particlesLost": "particles lost",
}
ERRORS = {
    "solidVolumeError": "solid volume in the cells minus that of the particles, relative to the latter",
    "insertionError": "solid volume inserted minus removed minus present, relative to that of the particles",
    "clippedVolume": "solid volume clipped at alphaMin [m3]",
    "momentumError": "momentum that particles received minus that given by the fluid, relative to all of a step",
    "pressureForceError": "difference between the pressure force on the particles and its reaction in the fluid",
    "continuityError": "continuity error of the water in a coupling step, relative to the volume",
    "imbalance": "volume that a closed tank could not balance, relative to its volume",
}
SETTINGS = (
    "parameters",
    "step",
    "constant/couplingProperties",
    "constant/transportProperties",
    "constant/g",
    "system/controlDict",
    "system/fvSchemes",
    "system/fvSolution",
    "0/U",
    "0/p",
)
# Headings of the log's first part that are reported as they stand.
SECTIONS = ("Versions", "Models", "Equations", "Time scales", "Sizes")
STYLE = """body { font: 16px/1.45 sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em; color: #222; }
h1 { font-size: 1.5em } h2 { font-size: 1.15em; margin-top: 2em; border-bottom: 1px solid #ccc }
td, th { padding: .15em 1em .15em 0; text-align: left; vertical-align: top }
td.number { text-align: right; font-variant-numeric: tabular-nums }
pre { background: #f6f6f6; padding: .6em; overflow-x: auto; font-size: 13px }
.bad { color: #b00 } .bar { background: #9ec5e8; height: .9em; display: inline-block }
svg { max-width: 100%; height: auto }"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path, metavar="CASE")
    parser.add_argument("file", type=Path, metavar="FILE.html")
    given = parser.parse_args()
    if not (given.case / "log.pimpleDemFoam").exists():
        parser.error(f"{given.case} has no log.pimpleDemFoam: a case that has run, or is running, is wanted")
    whole_files.write(given.file, page(given.case))
    print(given.file)


def page(case: Path) -> str:
    log = Log((case / "log.pimpleDemFoam").read_text(errors="replace"))
    balances = case_files.balances(case)
    name = html.escape(case.resolve().name)
    parts = [
        f"<h1>{name}: {html.escape(log.state())}</h1>",
        first_sentences(case, log, balances),
        measured(case),
        conservation(balances),
        phases(balances),
    ]
    parts += [f"<h2>{heading}</h2>{preformatted(text)}" for heading, text in log.sections()]
    parts += [amiss(log), settings(case)]
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta'
        f' charset="utf-8"><title>{name}</title><style>{STYLE}</style></head>\n<body>\n'
        + "\n".join(filter(None, parts))
        + "\n</body></html>\n"
    )


class Log:
    """log.pimpleDemFoam, of one start or of several; what a run consists of is reported by the last."""

    def __init__(self, text: str) -> None:
        self.starts = re.split(r"(?=^Exec  *:)", text, flags=re.M)[1:] or [text]
        self.last = self.starts[-1]

    def reached(self) -> float | None:
        """The time that the last start has come to."""
        return max(map(float, re.findall(r"^(?:t|Time) = ([-+.\de]+)", self.last, flags=re.M)), default=None)

    def state(self) -> str:
        at = self.reached()
        up_to = "" if at is None else f" at t = {at:g} s"
        if "FOAM FATAL" in self.last:
            return "ended by an error" + up_to
        if re.search(r"^Asked to stop", self.last, flags=re.M):
            return "stopped" + up_to + "; it can go on"
        return ("ended" if re.search(r"^End$", self.last, flags=re.M) else "has not ended:") + up_to

    def sections(self) -> Iterator[tuple[str, str]]:
        for heading in SECTIONS:
            found = re.search(rf"^({heading}[^\n]*)\n((?:    [^\n]*\n)+)", self.last, flags=re.M)
            if found:
                yield html.escape(found[1]), found[2]

    def fatal(self) -> list[str]:
        return re.findall(r"^--> FOAM FATAL.*?(?=^FOAM \w+ing|\Z)", self.last, flags=re.M | re.S)

    def warnings(self) -> dict[str, int]:
        """Each once, with how often it was said."""
        said: dict[str, int] = {}
        for start in self.starts:
            for text in re.findall(r"^--> FOAM Warning.*?(?=\n\n|\Z)|^WARNING: [^\n]*", start, flags=re.M | re.S):
                said[text.strip()] = said.get(text.strip(), 0) + 1
        return said


def first_sentences(case: Path, log: Log, balances: list[dict[str, Any]]) -> str:
    """What one looks for first: did it end, is anything amiss, do the balances balance."""
    sentences = [f"{len(log.starts)} starts." if len(log.starts) > 1 else ""]
    if balances:
        lost = sum(part["particlesLost"] for part in balances)
        sentences.append(
            f"{balances[0]['particlesStart']} particles at the start, {balances[-1]['particlesEnd']} at the end, "
            + (f'<b class="bad">{lost} lost</b>.' if lost else "none lost.")
        )
        sentences.append(
            f"Solid volume is kept to {largest(balances, 'solidVolumeError'):.1e}, momentum to"
            f" {largest(balances, 'momentumError'):.1e}."
        )
        sentences += [
            f'<b class="bad">The balances of {start:g} to {end:g} s are missing</b>: that part was killed, or did not'
            " come to its end."
            for start, end in case_files.missing_balances(case, balances, log.reached() or 0)
        ]
    else:
        sentences.append("No conservation check's summary: it is written when a run ends.")
    warnings = log.warnings()
    sentences.append(f'<a href="#amiss">{len(warnings)} warnings</a>.' if warnings else "No warnings.")
    return f"<p>{' '.join(filter(None, sentences))}</p>"


def largest(balances: list[dict[str, Any]], name: str) -> float:
    return max(abs(part.get(name, 0)) for part in balances)


def measured(case: Path) -> str:
    """Curves of what the function objects observed."""
    shown = flow_drawing.observable(case)
    if not shown:
        return ""
    label, _, time, value = shown
    curves = [(label, time, value)]
    if label.startswith("mass") and time[-1] - time[0] > 4 * flow.DEVIATION:
        curves.append(("rate of outflow [g/s]", *flow.smoothed_rate(time, value)))
    figure, panels = pyplot.subplots(
        1, len(curves), figsize=(5.2 * len(curves), 3.4), constrained_layout=True, squeeze=False
    )
    for axes, (name, at, values) in zip(panels[0], curves):
        axes.plot(at, values, color=picture_style.LINE)
        axes.set(xlabel="time [s]", ylabel=name, xlim=(0, None))
        axes.set_ylim(bottom=min(0, values.min()))
        axes.grid(alpha=0.3)
    text = io.StringIO()
    figure.savefig(text, format="svg")
    pyplot.close(figure)
    return (
        "<h2>Measured</h2>"
        + re.sub(r"^.*?(?=<svg)", "", text.getvalue(), flags=re.S)
        + f"<p>{html.escape(label)}: {value[0]:.4g} at t = {time[0]:.4g} s, {value[-1]:.4g} at t = {time[-1]:.4g} s"
        + (f". Rate: slope of a parabola in a Gaussian window, sd {flow.DEVIATION} s" if len(curves) > 1 else "")
        + ".</p>"
    )


def table(rows: Iterable[Sequence[tuple[str, bool]]]) -> str:
    return (
        "<table>"
        + "".join(
            "<tr>" + "".join(f"<td{' class=number' if number else ''}>{cell}</td>" for cell, number in row) + "</tr>"
            for row in rows
        )
        + "</table>"
    )


def conservation(balances: list[dict[str, Any]]) -> str:
    if not balances:
        return ""
    rows = [((text, False), (str(sum(part.get(name, 0) for part in balances)), True)) for name, text in COUNTED.items()]
    rows += [
        ((text, False), (f"{largest(balances, name):.2e}", True))
        for name, text in ERRORS.items()
        if any(name in part for part in balances)
    ]
    return (
        "<h2>Balances</h2>"
        + table(rows)
        + "<p>The largest of all parts. Above its tolerance (conservationCheck { } of couplingProperties) the run would"
        " have ended.</p>"
    )


def phases(balances: list[dict[str, Any]]) -> str:
    if not balances:
        return ""
    seconds: dict[Any, Any] = {}
    for part in balances:
        for phase, time in part["phaseSeconds"].items():
            seconds[phase] = seconds.get(phase, 0) + time
    whole = sum(seconds.values()) or 1
    rows = [
        (
            (html.escape(phase), False),
            (f"{time:.1f} s", True),
            (f"{100 * time / whole:.0f} %", True),
            (f'<span class="bar" style="width:{20 * time / whole:.2f}em"></span>', False),
        )
        for phase, time in sorted(seconds.items(), key=lambda item: -item[1])
    ]
    wall = sum(part["wallSeconds"] for part in balances)
    return (
        f"<h2>Time</h2><p>{wall:.0f} s on {balances[-1]['ranks']} rank{'s' if balances[-1]['ranks'] > 1 else ''}.</p>"
        + table(rows)
    )


def amiss(log: Log) -> str:
    """Errors, warnings; among them which files of the case nobody has read. An entry that is unknown is an error at the
    start."""
    said = ['<h2 id="amiss">Not read, warnings, errors</h2>']
    said += [preformatted(text, "bad") for text in log.fatal()]
    said += [preformatted(text + (f"\n({count} times)" if count > 1 else "")) for text, count in log.warnings().items()]
    if len(said) == 1:
        said.append("<p>None: every entry and every field of the case was read.</p>")
    return "\n".join(said)


def settings(case: Path) -> str:
    said = ["<h2>Settings</h2><p>As they are now; what a resumed run began with may have been another.</p>"]
    files = [case / name for name in SETTINGS] + sorted((case / "DEM").glob("in.*"))
    for file in files:
        if file.is_file():
            said.append(
                f"<details><summary>{html.escape(str(file.relative_to(case)))}</summary>"
                f"{preformatted(file.read_text(errors='replace'))}</details>"
            )
    return "\n".join(said)


def preformatted(text: str, kind: str = "") -> str:
    return f"<pre{f' class={kind}' if kind else ''}>{html.escape(text.rstrip())}</pre>"


if __name__ == "__main__":
    main()
