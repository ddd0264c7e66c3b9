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


def write(file: Path, figures: Any, options: Any) -> None:
    whole_files.write(
        file,
        json.dumps(
            {
                "machine": machine(),
                "commit": commit(),
                "quick": options.quick,
                "realTime": options.realTime,
                "entries": {name: entry(figure) for name, figure in figures.items()},
            },
            indent=2,
        )
        + "\n",
    )


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
    model = next(
        (
            line.split(":", 1)[1].strip()
            for line in Path("/proc/cpuinfo").read_text().splitlines()
            if line.startswith("model name")
        ),
        platform.processor(),
    )
    return (
        f"{model}, {os.cpu_count()} cores, {datetime.date.today()}, "
        f"load {os.getloadavg()[2]:.1f} (mean of the last 15 minutes)"
    )
