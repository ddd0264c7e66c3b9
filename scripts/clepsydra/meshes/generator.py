"""The command line of the mesh generators."""

import argparse
from pathlib import Path
from typing import NamedTuple


class Options(NamedTuple):
    only_count: bool
    parameters: str  # a file; it may be a pipe
    case: Path  # where the files go; the working folder where cells are only counted


def read_options(name: str, description: str | None) -> Options:
    parser = argparse.ArgumentParser(
        prog=name, description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cells", action="store_true", help="print about how many cells there will be, make nothing")
    parser.add_argument("parameters", metavar="PARAMETERS")
    parser.add_argument("case", type=Path, metavar="CASE", nargs="?", help="where the files go; not with --cells")
    given = parser.parse_args()
    if given.cells == (given.case is not None):
        parser.error("either --cells PARAMETERS or PARAMETERS CASE")
    return Options(given.cells, given.parameters, given.case or Path())
