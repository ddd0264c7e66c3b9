"""Where ranks wait for each other. Each collective call of a coupling step is one of RankTotals, which counts them for
`reductionsPerStep`; every other collective call is at the start of a run, at its write times or before its end by an
error. A call that is new fails here until it is known which of these it is."""

import re
import unittest
from collections import Counter
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]

CALLS = re.compile(
    r"\b(returnReduce|reduce|combineReduce|gSum\w*|gMax\w*|gMin\w*|gAverage\w*|weightedAverage|domainIntegrate"
    r"|(?:list|map)?[cC]ombine(?:Gather|Scatter)|gatherList|scatterList|gather|scatter|exchangeSizes|Pstream::exchange"
    r"|firstOfRanks|problemOfRanks|waitForAllRanks"
    r"|MPI_I?(?:[Aa]ll\w+|[Rr]educe\w*|[Bb]cast|[Bb]arrier|[Gg]atherv?|[Ss]catterv?|[Ss]can|[Ee]xscan))"
    r"(?:<[^<>;]*(?:<[^<>]*>)?[^<>;]*>)?\("
)
TOTALS = re.compile(r"\b(?:RankTotals::of|totals\.reduce)\(")

START, WRITE, ERROR, ROW = "at the start", "at write times", "before an error ends the run", "with a row of its table"

# Number of calls by file, and when they are made.
OTHERS = {
    "coupling/checkpoint/caseLock.cpp": (1, START),
    "coupling/checkpoint/checkpoints.cpp": (14, f"{START} and {WRITE}"),
    "coupling/checkpoint/partsOfCase.cpp": (2, START),
    "coupling/checkpoint/runInputs.cpp": (6, START),
    "coupling/conservation/conservationCheck.cpp": (2, f"{ERROR}; the volume of the mesh, once"),
    "coupling/conservation/particleCensus.cpp": (2, ERROR),
    "coupling/couplingStep/bedEdge.cpp": (2, "once, at the first write time with a bed"),
    "coupling/couplingStep/meanPressureGradient.cpp": (1, START),
    "coupling/couplingStep/particlesOutsideMesh.cpp": (4, ERROR),
    "coupling/couplingStep/voidFractionRate.cpp": (2, f"{START}; where the mesh has moved"),
    "coupling/distribution/cellDiffusion.cpp": (5, START),
    "coupling/distribution/cyclicPatches.cpp": (6, START),
    "coupling/distribution/lengthOfChange.h": (2, START),
    "coupling/distribution/wayAroundWalls.cpp": (4, START),
    "coupling/engine/liggghts/liggghtsParticles.cpp": (1, START),
    "coupling/engine/liggghts/removal.cpp": (1, "where particles have left"),
    "coupling/engine/liggghts/restartFiles.cpp": (4, f"{START} and {WRITE}"),
    "coupling/engine/liggghts/scriptFacts.cpp": (1, START),
    "coupling/engine/liggghts/subdomains.cpp": (
        4,
        "fix balance: once in so many DEM steps, and with a row of LIGGGHTS' table",
    ),
    "coupling/exchange/particleExchange.cpp": (1, "where particles have left the boxes that were published"),
    "coupling/functionObjects/hopperCylinder.cpp": (3, START),
    "coupling/functionObjects/massInHopper.cpp": (3, f"{START}, {WRITE} and {ROW}"),
    "coupling/functionObjects/particleHeight.cpp": (2, START),
    "coupling/insertionAndRemoval/insertionAndRemoval.cpp": (2, f"{START} and {WRITE}"),
    "coupling/insertionAndRemoval/particleOutlets.cpp": (5, START),
    "coupling/openfoam/objectFile.h": (1, START),
    "coupling/output/particleWriter.cpp": (5, WRITE),
    "coupling/rankTotals.cpp": (1, "the reduction itself"),
    "coupling/ranks.h": (6, f"{START}, {WRITE} and {ERROR}"),
    "coupling/run/caseSizes.cpp": (2, START),
    "coupling/run/demTimeScales.cpp": (2, START),
    "coupling/run/runOutput.cpp": (2, "at the end"),
    "solvers/pimpleDemFoam/movingWalls.cpp": (5, START),
    "solvers/pimpleDemFoam/wallsOfMovingMesh.cpp": (8, "where the mesh has moved"),
}

# Reductions of RankTotals by file, and when they are made in a coupling step.
REDUCTIONS = {
    "coupling/conservation/particleCensus.cpp": (2, f"{START}; where particles have left"),
    "coupling/couplingStep/couplingStep.cpp": (
        4,
        "one at the end, one for an adjustable length, one at the start",
    ),
    "coupling/couplingStep/fluidCoupling.cpp": (
        3,
        f"one before the fluid is solved, two {START} and {WRITE}",
    ),
    "coupling/couplingStep/particleMapping.cpp": (1, f"{START} and {WRITE}"),
    "coupling/couplingStep/voidFractionRate.cpp": (
        1,
        "in each pressure equation where p is fixed nowhere and a patch is not noSlip",
    ),
    "coupling/distribution/cellDiffusion.cpp": (2, "where the cells near particles are not those of the plan"),
    "coupling/exchange/particleExchange.cpp": (1, "one where particles may be outside the mesh"),
    "coupling/functionObjects/massInHopper.cpp": (1, ROW),
    "coupling/functionObjects/particleHeight.cpp": (1, ROW),
    "coupling/functionObjects/particleMeans.cpp": (1, ROW),
    "coupling/insertionAndRemoval/insertionAndRemoval.cpp": (1, "where particles have left"),
}


def code(file: Path) -> str:
    return re.sub(r"//[^\n]*", "", file.read_text())


def found(pattern: re.Pattern[str]) -> Counter[str]:
    counts: Counter[str] = Counter()
    for folder in ("coupling", "solvers"):
        for file in sorted((REPOSITORY / folder).rglob("*")):
            if file.suffix in (".h", ".cpp", ".C") and (count := len(pattern.findall(code(file)))):
                counts[str(file.relative_to(REPOSITORY))] = count
    return counts


class CollectiveCalls(unittest.TestCase):
    maxDiff = None

    def test_each_is_known(self) -> None:
        """By file, so that one cannot take the place of another. Those of RankTotals are counted in the next test."""
        others = {}
        for file, count in found(CALLS).items():
            rest = count - len(re.findall(r"\btotals\.reduce\(|::reduce\(\)|bool reduce\(", code(REPOSITORY / file)))
            if rest:
                others[file] = rest
        self.assertEqual(others, {file: count for file, (count, _) in OTHERS.items()})

    def test_each_reduction_of_totals_is_known(self) -> None:
        counts = {file: count for file, count in found(TOTALS).items() if "rankTotals" not in file}
        self.assertEqual(counts, {file: count for file, (count, _) in REDUCTIONS.items()})

    def test_the_search_finds_them(self) -> None:
        """Otherwise everything would pass. Each line is one call."""
        for line in (
            "x = returnReduce(x, sumOp<label>());",
            "reduce(x, maxOp<scalar>());",
            "const double all = gSum(field);",
            "Foam::gMax(Foam::mag(phi))",
            "error.weightedAverage(V).value()",
            "Pstream::gatherList(lists);",
            "MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_INT, MPI_MAX, world);",
            "MPI_Allgather(a, 6, MPI_DOUBLE, b, 6, MPI_DOUBLE, world);",
            "MPI_Iallreduce(a, b, 1, MPI_INT, MPI_MAX, world, &request);",
            "MPI_Bcast(&count, 1, MPI_INT, 0, world);",
            "MPI_Barrier(world);",
        ):
            self.assertEqual(len(CALLS.findall(line)), 1, line)
        for line in ("MPI_Isend(a, 1, MPI_INT, 1, 1, world, &request);", "fvc::surfaceSum(phi)", "sum(field)"):
            self.assertEqual(len(CALLS.findall(line)), 0, line)


if __name__ == "__main__":
    unittest.main()
