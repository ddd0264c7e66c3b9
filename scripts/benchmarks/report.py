"""The table and the JSON file of scripts/benchmark."""

import datetime
import json
import os
import platform
from pathlib import Path


def table(figures):
    lines = [f"{'':24}{'median':>9}{'min':>9}{'max':>9}  {'target':8}"]
    for name, figure in figures.items():
        lines.append(f"{name:24}{figure.median:9.3g}{min(figure.values):9.3g}{max(figure.values):9.3g}"
                     f"  {figure.target:8}{figure.meaning}")
    return "\n".join(lines + [machine()])


def write(file, figures, quick):
    entries = {name: {"median": figure.median, "min": min(figure.values), "max": max(figure.values),
                      "values": figure.values, "target": figure.target, "meaning": figure.meaning,
                      "details": figure.details}
               for name, figure in figures.items()}
    file.write_text(json.dumps({"machine": machine(), "quick": quick, "entries": entries}, indent=2) + "\n")


def machine():
    """Processor, cores, date, and how busy the machine was: above the number of cores no time is to be trusted."""
    model = next((line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines()
                  if line.startswith("model name")), platform.processor())
    return (f"{model}, {os.cpu_count()} cores, {datetime.date.today()}, "
            f"load {os.getloadavg()[2]:.1f} (mean of the last 15 minutes)")
