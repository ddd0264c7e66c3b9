"""The table and the JSON file of scripts/benchmark."""

import datetime
import json
import os
import platform
from pathlib import Path
from typing import Any

from clepsydra import whole_files
from clepsydra.environment import commit


def table(figures: Any) -> str:
    """Figures by name; a text in place of a figure is the reason why there is none."""
    lines = [f"{'':36}{'median':>9}{'min':>9}{'max':>9}  target"]
    for name, figure in figures.items():
        if isinstance(figure, str):
            lines.append(f"{name:36}{'skipped':>9}{'':18}  {figure}")
        else:
            lines.append(
                f"{name:36}{figure.median:9.3g}{min(figure.values):9.3g}{max(figure.values):9.3g}"
                f"  {figure.target:8}{figure.meaning}"
            )
    return "\n".join(lines + [machine()])


def earlier_entries(file: Path, options: Any) -> dict[str, Any]:
    """Those of a file that is there; SystemExit where they are not of this machine and commit, measured alike."""
    if not file.exists():
        return {}
    try:
        found = json.loads(file.read_text())
        entries = dict(found["entries"])
        earlier = {name: found[name] for name in conditions(options)} | {"machine": found["machine"].rsplit(", ", 2)[0]}
    except (ValueError, KeyError, TypeError, AttributeError):
        raise SystemExit(f"benchmark: {file} is there, and no file of results; allowed: another FILE") from None
    for name, now in conditions(options).items():
        if earlier[name] != now:
            raise SystemExit(
                f"benchmark: {file}: entry '{name}' is {earlier[name]!r}, and {now!r} now; allowed: another FILE, or "
                "one with entries of this machine and commit, measured alike"
            )
    return entries


def write(file: Path, earlier: dict[str, Any], figures: Any, options: Any) -> None:
    """earlier: entries to keep, but for those that are measured again."""
    entries = earlier | {name: entry(figure) for name, figure in figures.items()}
    results = conditions(options) | {"machine": machine(), "entries": entries}
    whole_files.write(file, json.dumps(results, indent=2) + "\n")


def conditions(options: Any) -> dict[str, Any]:
    """What the entries of a file have in common."""
    return {"machine": processor(), "commit": commit(), "quick": options.quick, "realTime": options.realTime}


def entry(figure: Any) -> dict[str, Any]:
    if isinstance(figure, str):
        return {"skipped": figure}
    return {
        "median": figure.median,
        "min": min(figure.values),
        "max": max(figure.values),
        "values": figure.values,
        "target": figure.target,
        "meaning": figure.meaning,
        "details": figure.details,
    }


def machine() -> str:
    """Processor, cores, date, and how busy the machine was: above the number of cores no time is to be trusted."""
    return f"{processor()}, {datetime.date.today()}, load {os.getloadavg()[2]:.1f} (mean of the last 15 minutes)"


def processor() -> str:
    """And its cores."""
    model = next(
        (
            line.split(":", 1)[1].strip()
            for line in Path("/proc/cpuinfo").read_text().splitlines()
            if line.startswith("model name")
        ),
        platform.processor(),
    )
    return f"{model}, {os.cpu_count()} cores"
