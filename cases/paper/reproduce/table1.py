#!/usr/bin/python3
"""Table I: Re, C_d and I of the three particles, from measured terminal velocities' fit (Brown & Lawler) and the drag
laws."""


import comparisons
import output


def main(folder: output.Folder) -> None:
    rows = comparisons.table_i()
    print(comparisons.table(rows))
    folder.numbers(
        "table1",
        ["quantity", "paper", "ours", "residual [%]"],
        [(row["quantity"], row["paperSimulation"], row["ours"], row["residualPercent"]) for row in rows],
    )


output.command(main, __doc__, [])
