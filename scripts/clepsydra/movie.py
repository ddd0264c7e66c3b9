#!/usr/bin/python3
"""Film of a case that has run or is running: particles as spheres coloured by speed, the water's speed and streamlines,
and the mass in the hopper.

Usage: movie [options] CASE FILE...

One picture for each time at which the case has written its particles (entries `drawParticles` and `fieldInterval` of
the quick hopper's `parameters`). Each FILE is made of the same pictures, by its ending: .mp4 or .webm, a film; .gif,
.webp or .apng, a small animation that pages show. """

import argparse
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from clepsydra import case_files, flow_drawing, picture_style
from clepsydra.picture_style import pyplot

EVEN = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white"  # players want even sizes
SMALL = "scale={width}:-1:flags=lanczos"
# Options of ffmpeg for each ending.
ENDINGS = {
    ".mp4": ["-vf", EVEN, "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20"],
    ".webm": ["-vf", EVEN, "-c:v", "libvpx-vp9", "-pix_fmt", "yuv420p", "-crf", "30", "-b:v", "0"],
    ".gif": [
        "-vf",
        SMALL + ",split[all][of];[of]palettegen[palette];[all][palette]paletteuse=dither=none",
        "-loop",
        "0",
    ],
    ".webp": ["-vf", SMALL, "-c:v", "libwebp_anim", "-quality", "70", "-loop", "0"],
    ".apng": ["-vf", SMALL, "-f", "apng", "-plays", "0"],
}


def main() -> None:
    given = read_options()
    times = flow_drawing.written_times(given.case)
    first, last = given.between
    chosen = [at for at in sorted(times) if first <= at <= last and is_whole(given.case, at)][:: given.every]
    if not chosen:
        sys.exit(f"movie: {given.case} has written no particles {f'from {first:g} to {last:g} s' if times else 'yet'}")
    view = flow_drawing.View(given.case, given.view and [1e-3 * edge for edge in given.view])
    moments = [flow_drawing.Moment(given.case, view, at, *times[at]) for at in chosen]
    fastest_particle = max(moment.fastest_particle(view) for moment in moments)
    fastest_water = max(moment.fastest_water() for moment in moments)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for number, moment in enumerate(moments):
            figure = flow_drawing.draw(given.case, view, moment, fastest_particle, fastest_water)
            figure.savefig(folder / f"{number:05d}.png", dpi=picture_style.DPI)
            pyplot.close(figure)
        for file in given.files:
            encode(folder, file, given)
            print(f"{file}: {len(moments)} pictures, {file.stat().st_size / 1e6:.2f} MB")


def read_options() -> Any:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--every", type=int, default=1, metavar="N", help="each N-th written time only")
    parser.add_argument(
        "--between",
        type=float,
        nargs=2,
        metavar=("T0", "T1"),
        default=(-math.inf, math.inf),
        help="in s; else the whole run",
    )
    parser.add_argument("--fps", type=float, default=10, help="pictures a second (%(default)g)")
    parser.add_argument("--width", type=int, default=720, help="of animations, in pixels (%(default)d)")
    parser.add_argument(
        "--view",
        type=float,
        nargs=4,
        metavar=("X0", "X1", "Z0", "Z1"),
        help="in mm; else the hopper and the water below it, or the whole mesh",
    )
    parser.add_argument("case", type=Path, metavar="CASE")
    parser.add_argument("files", type=Path, nargs="+", metavar="FILE")
    given = parser.parse_args()
    for file in given.files:
        if file.suffix not in ENDINGS:
            parser.error(f"'{file}' ends in '{file.suffix}'; allowed: {', '.join(ENDINGS)}")
    if given.every < 1 or given.fps <= 0 or given.width < 16:
        parser.error("--every, --fps and --width are numbers above 0 (a width of 16 at least)")
    if given.view and not (given.view[0] < given.view[1] and given.view[2] < given.view[3]):
        parser.error("--view is X0 < X1 and Z0 < Z1")
    if not given.between[0] < given.between[1]:
        parser.error("--between is T0 < T1")
    if not (given.case / "VTK/particles.pvd").exists():
        parser.error(
            f"{given.case} has no VTK/particles.pvd: a case that has run, and writes its particles (drawParticles on;),"
            " is wanted"
        )
    if not shutil.which("ffmpeg"):
        parser.error("there is no ffmpeg here: apt-get install ffmpeg (scripts/setup does)")
    return given


def is_whole(case: Path, at: float) -> bool:
    """Not what a running case is writing at this very moment."""
    times = {float(name): name for name in case_files.times(case)}
    newest = max(times, default=None)
    return newest is None or at < 0.999999 * newest or (case / "checkpoints" / times[newest] / "complete").exists()


def encode(folder: Path, file: Path, given: argparse.Namespace) -> None:
    """A film is there whole or not at all."""
    unfinished = file.with_name(f"unfinished.{file.name}")
    options = [option.format(width=given.width) for option in ENDINGS[file.suffix]]
    done = subprocess.run(
        [
            "ffmpeg",
            "-loglevel",
            "error",
            "-y",
            "-framerate",
            f"{given.fps:g}",
            "-i",
            f"{folder}/%05d.png",
            *options,
            unfinished,
        ],
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
    )
    if done.returncode != 0:
        unfinished.unlink(missing_ok=True)
        sys.exit(f"movie: ffmpeg made no {file}: {done.stderr.strip()}")
    unfinished.rename(file)


if __name__ == "__main__":
    main()
