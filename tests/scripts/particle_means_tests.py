"""Profiles from tables of particleMeans: means over bins and their errors, on tables whose answer is known."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from clepsydra import particle_means


class Profiles(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-means-")
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name)

    def write(self, rows: list[tuple[float, ...]], start: str = "0") -> None:
        """(time, x, z, sampled times, particles, speed) of each."""
        table = self.case / "postProcessing/particleMeans" / start / "particleMeans.dat"
        table.parent.mkdir(parents=True)
        lines = [f"{t} {x} 0.02 {z} {n} {count} {speed} 0 0 0 0 0.5" for t, x, z, n, count, speed in rows]
        table.write_text("\n".join(["# means", *lines, ""]))

    def test_particles_weigh_alike(self) -> None:
        """30 particles of 1 m/s and 10 of 5 m/s within reach: 2 m/s. The mean of the two bins would be 3 m/s; the bin
        outside of the reach in x and the one outside in height would change it."""
        rows = [(1.0, -0.5, 0.1, 10, 30, 1), (1.0, 0.5, 0.1, 10, 10, 5), (1.0, 1.5, 0.1, 10, 99, 9)]
        self.write([*rows, (1.0, 0.5, 2.1, 10, 99, 9)])
        found = particle_means.ParticleMeans(self.case).profile(0.2, 1, 0, 2, 1, 1)
        self.assertAlmostEqual(found.speed[0], 2)
        self.assertAlmostEqual(found.speed[1], (10 * 5 + 99 * 9) / 109)
        self.assertTrue(np.isnan(found.error).all(), "one block tells no error")

    def test_errors_are_those_of_blocks(self) -> None:
        """Four blocks of one second with means of 1, 2, 3 and 4 m/s of equal numbers: 2.5 m/s, and the standard error
        of four independent values. Rows between the ends of blocks, and one of the first sample, change nothing."""
        rows: list[tuple[float, ...]] = [(2.0, 0.0, 0.0, 1, 10, 1.0)]
        total = 10.0
        for half in range(8):
            total += 990 * (1 + half // 2) if half == 0 else 1000 * (1 + half // 2)
            count = 1000 * (half + 1)
            rows.append((2.5 + 0.5 * half, 0.0, 0.0, count / 10, count, total / count))
        self.write(rows)
        found = particle_means.ParticleMeans(self.case).profile(0, 1, 0, 0, 1, 1)
        self.assertAlmostEqual(found.speed[0], 2.5)
        self.assertAlmostEqual(found.error[0], np.std([1, 2, 3, 4], ddof=1) / 2)
        np.testing.assert_allclose(found.blocks[:, 0], [1, 2, 3, 4])

    def test_a_later_part_wins(self) -> None:
        self.write([(1.0, 0, 0, 10, 10, 1), (2.0, 0, 0, 20, 20, 7)])
        self.write([(2.0, 0, 0, 20, 20, 2), (3.0, 0, 0, 30, 30, 3)], "2")
        means = particle_means.ParticleMeans(self.case)
        self.assertEqual(list(means.times), [1, 2, 3])
        self.assertEqual(means.sums(2.0, np.array([0.0]), 0, 1)[1, 0], 40)

    def test_width_and_mean(self) -> None:
        """A triangle of height 2 from -1 to 3 with its peak at 1 is 2 wide at half its height; its mean over -3 to 5 is
        0.5. A peak at the edge has no width."""
        x = np.array([-3.0, -1, 1, 3, 5])
        speed = np.array([0.0, 0, 2, 0, 0])
        self.assertAlmostEqual(particle_means.width_at_half(x, speed), 2)
        self.assertAlmostEqual(particle_means.mean_across(x, speed), 0.5)
        self.assertTrue(np.isnan(particle_means.width_at_half(x[2:], speed[2:])))


if __name__ == "__main__":
    unittest.main()
