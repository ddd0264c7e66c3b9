"""The comparisons of scripts/benchmark, a module each, and what they share: timing, hopper, report."""
