"""The parts of scripts/faults: bench (a small case, what an undisturbed run of it leaves), kinds of faults, report."""
