#!/usr/bin/python3
"""Mean, swing and main frequency of a signal, with errors from its periods."""

import unittest

import numpy as np

from clepsydra import periods


class OfASine(unittest.TestCase):
    def test_without_noise(self) -> None:
        """3 + 2 sin: a deviation of sqrt(2), exactly periodic; at times that are not evenly spaced."""
        time = np.sort(np.random.default_rng(1).uniform(0, 10, 20000))
        found = periods.swings(time, 3 + 2 * np.sin(2 * np.pi * 2.5 * time))
        self.assertEqual(found.periods, 23)  # the first rise is that of the second period
        self.assertAlmostEqual(found.mean.value, 3, delta=0.01)
        self.assertAlmostEqual(found.deviation.value, 2**0.5, delta=0.01)
        self.assertAlmostEqual(found.frequency.value, 2.5, delta=1e-3)
        self.assertLess(found.mean.error + found.frequency.error, 1e-2)

    def test_errors_are_those_of_repeats(self) -> None:
        """Each period has a mean of its own, spread by 0.3: the error of the mean of 40 is 0.3/sqrt(40)."""
        spread = np.repeat(np.random.default_rng(2).normal(0, 0.3, 41), 100)
        time = np.arange(len(spread)) / 100
        found = periods.swings(time, spread + 2 * np.sin(2 * np.pi * (time + 0.25)))
        self.assertAlmostEqual(found.mean.error, 0.3 / 40**0.5, delta=0.02)

    def test_noise_at_the_mean_begins_no_period(self) -> None:
        time = np.linspace(0, 8, 8001)
        noise = np.random.default_rng(3).normal(0, 0.05, len(time))
        self.assertEqual(periods.swings(time, np.sin(2 * np.pi * time) + noise).periods, 6)

    def test_too_few_periods(self) -> None:
        with self.assertRaisesRegex(ValueError, "allowed: 3 and more"):
            periods.swings(np.linspace(0, 2, 200), np.sin(2 * np.pi * np.linspace(0, 2, 200)))


if __name__ == "__main__":
    unittest.main()
