#!/usr/bin/python3
"""Makes the mesh of the paper's hopper (cases/paper/hopper.yaml) at one level, checks it and draws it.

The mesh lies in meshes/made/<level>/constant/polyMesh then, its picture in meshes/made/<level>.png. Printed: cells,
seconds of computing, and memory of the largest program. """

import argparse
import json
import resource
import shutil
import subprocess
import sys

from clepsydra.environment import REPOSITORY, SCRIPTS
from clepsydra.parameter_studies.plan import ParameterStudy, ParameterStudyError, Task
from clepsydra.parameter_studies.task import make_folder

MESHES = REPOSITORY / "meshes"


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="paperHopper", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("level", choices=("quick", "coarse", "medium", "paper"))
    parser.add_argument("wishes", metavar="PARAMETER=VALUE", nargs="*", help="for instance wallThickness=3e-3")
    given = parser.parse_args()
    if not all("=" in word for word in given.wishes):
        parser.error("PARAMETER=VALUE: there is no = in it")
    level, wishes = given.level, dict(word.split("=", 1) for word in given.wishes)
    parameter_study = ParameterStudy(REPOSITORY / "cases/paper/reference.yaml")
    parameter_study.work = MESHES / "made"
    overrides = {**parameter_study.common, "meshLevel": level, **wishes}
    unknown = set(overrides) - set(parameter_study.defaults)
    if unknown:
        raise ParameterStudyError(
            f"unknown parameter {', '.join(unknown)}; allowed: {', '.join(parameter_study.defaults)}"
        )
    task = Task(
        name=level, part="mesh", ranks=1, overrides=tuple(overrides.items()), needs=(), links=(), publish="", entry=""
    )
    folder = parameter_study.folder(task)
    shutil.rmtree(folder, ignore_errors=True)
    make_folder(parameter_study, task)
    subprocess.run(["./Allrun", "mesh"], cwd=folder, check=True)

    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(
        json.dumps(
            {
                "level": level,
                "computingSeconds": round(used.ru_utime + used.ru_stime, 1),
                "memoryMB": round(used.ru_maxrss / 1024),
            }
        )
    )
    subprocess.run([SCRIPTS / "renderMesh", folder, parameter_study.work / f"{level}.png"], check=True)


if __name__ == "__main__":
    try:
        main()
    except ParameterStudyError as problem:
        sys.exit(f"paperHopper: {problem}")
    except subprocess.CalledProcessError as failure:
        sys.exit(failure.returncode)
