"""The parts of scripts/faults: bench (a small case, and what an undisturbed run of it leaves), kinds of faults, report."""
