# SPDX-License-Identifier: GPL-3.0-or-later
"""Standard errors of means over successive blocks and turns: readings.means, and what uses them."""
import unittest

import numpy as np

from millfoam.readings.batches import batch_means, error_over_turns
from millfoam.readings.means import (CORRELATED, Mean, block_mean, by_resolution, deviation_freedom, mean_of_series,
                                     mean_variance, turns_mean)
from millfoam.readings.stirred_power import mean_from


def series(correlation, count, seed):
    """Stationary autoregressive process of first order about 0, with a variance of 1."""
    noise = np.random.default_rng(seed).normal(0, 1, count)
    values = np.empty(count)
    values[0] = noise[0]
    for k in range(1, count):
        values[k] = correlation * values[k - 1] + np.sqrt(1 - correlation**2) * noise[k]
    return values


def error_over_spread(correlation, count):
    """Root mean square of turns_mean's errors over the spread of the means that it has errors of."""
    found = [turns_mean(series(correlation, count, seed)) for seed in range(1500)]
    return np.sqrt(np.mean([one.error**2 for one in found])) / np.std([one.value for one in found])


class MeansTest(unittest.TestCase):
    def test_blocks_and_few_turns_have_the_plain_error(self):
        few, many = np.arange(CORRELATED - 1.0), np.arange(3.0 * CORRELATED)
        for found, values in ((turns_mean(few), few), (block_mean(few), few), (block_mean(many), many)):
            self.assertAlmostEqual(found.error, values.std(ddof=1) / np.sqrt(len(values)))
        self.assertTrue(np.isnan(turns_mean([1.0]).error))

    def test_equal_turns_have_no_error(self):
        for count in (2, 3 * CORRELATED):
            self.assertEqual(turns_mean(np.full(count, 2.5)).error, 0)

    def test_turns_that_alternate_have_the_plain_error(self):
        values = np.tile([-1.0, 1.0], CORRELATED)
        self.assertAlmostEqual(turns_mean(values).error, values.std(ddof=1) / np.sqrt(len(values)))

    def test_variance_of_a_mean(self):
        # Three values with correlations r, r, r^2: (3 + 4 r + 2 r^2)/9
        self.assertAlmostEqual(mean_variance(0.5, 3), (3 + 4 * 0.5 + 2 * 0.25) / 9)
        self.assertAlmostEqual(mean_variance(0, 7), 1 / 7)
        # Few values of which neighbours are nearly equal are like a single one
        self.assertAlmostEqual(mean_variance(1 - 1e-9, 7), 1)

    def test_error_of_independent_turns_is_hardly_larger(self):
        # Neighbours that are alike by chance count, those that differ by chance do not
        for count, most in ((CORRELATED, 1.35), (5 * CORRELATED, 1.15)):
            self.assertGreater(error_over_spread(0, count), 1)
            self.assertLess(error_over_spread(0, count), most)

    def test_error_of_turns_that_are_alike(self):
        # The plain errors are 0.32 and 0.17 of the spread
        for correlation, count, least, most in ((0.8, 40, 0.9, 1.6), (0.93, 40, 0.9, 1.6), (0.93, 16, 0.5, 0.9)):
            found = error_over_spread(correlation, count)
            self.assertGreater(found, least)
            self.assertLess(found, most)

    def test_a_correlation_that_is_known_makes_the_error_of_few_turns_honest(self):
        # Hold-ups that relax over 16 to 30 turns. Without it the errors are 0.12 to 0.76 of the spread
        for back in (16, 30):
            least = np.exp(-1 / back)
            for count in (6, 12, 24, 48):
                found = [turns_mean(series(least, count, seed), least) for seed in range(800)]
                spread = np.std([one.value for one in found])
                ratio = np.sqrt(np.mean([one.error**2 for one in found])) / spread
                self.assertTrue(0.9 < ratio < 1.3, ratio)
                self.assertGreater(np.mean([abs(one.value) < one.reach for one in found]), 0.94)

    def test_few_turns_that_are_alike_have_few_degrees_of_freedom(self):
        # With one degree less than turns it was 86 and 78 %
        for correlation, least in ((0.0, 0.95), (0.6, 0.88), (0.8, 0.82)):
            found = [turns_mean(series(correlation, 12, seed)) for seed in range(600)]
            covered = np.mean([abs(one.value) < one.reach for one in found])
            self.assertTrue(least < covered < 0.98, covered)

    def test_a_larger_correlation_than_the_known_one_counts(self):
        values = series(0.95, 40, seed=3)
        self.assertEqual(turns_mean(values, 0.1), turns_mean(values))
        self.assertLess(turns_mean(values).freedom, 10)
        self.assertEqual(turns_mean(series(0.0, 40, seed=3), 0.9).freedom, deviation_freedom(0.9, 40))

    def test_words_have_the_freedom_of_an_error_that_is_not_exact(self):
        self.assertEqual(Mean(1.2e-3, 1e-4, 2).full_text("mm", 1e3),
                         "1.2 ± 0.1 mm (95 %: ± 0.4, 2.0 degrees of freedom)")
        for one in (Mean(1.2e-3, 1e-4), Mean(1.2e-3, np.nan, 0)):
            self.assertEqual(one.full_text("mm", 1e3), one.text("mm", 1e3))

    def test_a_multiple_has_its_part_of_the_error(self):
        self.assertEqual(-2.0 * Mean(3.0, 0.5, 4), Mean(-6.0, 1.0, 4))

    def test_freedom_of_deviations(self):
        for count in (3, 12):
            self.assertAlmostEqual(deviation_freedom(0.0, count), count - 1)
        # Neighbours that are nearly equal show hardly more than a slope
        self.assertLess(deviation_freedom(0.999, 50), 3)
        self.assertAlmostEqual(deviation_freedom(0.5, 2), 1)
        self.assertEqual(turns_mean([2.0, 2.0], 0.9), Mean(2.0, 0.0, 1))

    def test_errors_of_flows_and_of_stirred_runs_allow_for_it(self):
        values = series(0.93, 40, seed=3)
        plain = values.std(ddof=1) / np.sqrt(40)
        times = np.arange(401) / 10
        of_turns = np.repeat(values, 10)
        self.assertGreater(error_over_turns(times[1:], of_turns, 0, 1), 2 * plain)
        self.assertGreater(mean_from(times[1:], of_turns, 0, 1).error, 2 * plain)


class StirredMeans(unittest.TestCase):
    """mean_from of a power that rises by 1 W in each turn of 1 s; records are means of the 0.1 s before them."""
    times = np.arange(1, 101) / 10

    def mean(self, begin, times=times):
        return mean_from(times, times - 0.05, begin, 1.0)

    def test_the_record_at_the_begin_is_of_the_time_before(self):
        self.assertAlmostEqual(self.mean(7.0).value, 8.5)
        self.assertAlmostEqual(self.mean(9.0).value, 9.5)  # one turn
        self.assertAlmostEqual(self.mean(9.02).value, 9.5)

    def test_the_value_is_of_the_turns_whose_error_is_given(self):
        found = self.mean(6.4)
        self.assertAlmostEqual(found.value, 8.5)
        self.assertAlmostEqual(found.error, 1 / np.sqrt(3))
        self.assertEqual(found.freedom, 2)

    def test_turns_may_begin_a_part_of_a_record_before(self):
        self.assertEqual((self.mean(7.06).freedom, self.mean(7.11).freedom), (2, 1))
        self.assertEqual(self.mean(6.96).freedom, 2)
        self.assertEqual(mean_from(self.times + 0.07, self.times, 7.07 - 0.06, 1.0).freedom, 2)

    def test_a_single_record_is_its_own_mean(self):
        for begin in (9.0, 9.97, 10.0):
            found = self.mean(begin, self.times[-1:])
            self.assertAlmostEqual(found.value, 9.95)
            self.assertTrue(np.isnan(found.error))
        self.assertAlmostEqual(self.mean(9.98).value, 9.95)


class Differences(unittest.TestCase):
    def test_reach_is_students(self):
        # Printed tables: 12.706, 4.303 and 2.776 for 1, 2 and 4 degrees of freedom
        for count, factor in ((2, 12.706), (3, 4.303), (5, 2.776)):
            found = block_mean(np.arange(float(count)))
            self.assertAlmostEqual(found.reach / found.error, factor, delta=1e-3)
        self.assertAlmostEqual(Mean(3.0, 1.0).reach, 1.96, delta=1e-3)

    def test_freedom_of_a_difference_is_welchs(self):
        # Equal errors of two turns each: 2; an error that is much the larger keeps its own
        self.assertAlmostEqual((Mean(1.0, 0.3, 1) - Mean(0.0, 0.3, 1)).freedom, 2)
        self.assertAlmostEqual((Mean(1.0, 0.3, 4) - Mean(0.0, 1e-6, 1)).freedom, 4, delta=1e-3)
        self.assertEqual((Mean(1.0) - Mean(0.5)).freedom, np.inf)
        self.assertEqual((Mean(1.0, 0.3, 4) - Mean(0.5)).freedom, 4)

    def test_two_turns_hardly_show_a_sign(self):
        self.assertEqual(block_mean([1.0, 1.1]).sign, 1)
        self.assertEqual(block_mean([1.0, 1.4]).sign, 0)  # 1.2 +- 0.2, six errors
        self.assertEqual(block_mean([-1.0, -1.4, -1.2]).sign, -1)
        self.assertEqual(block_mean([1.0]).sign, 0)
        self.assertEqual(Mean(0.0).sign, 0)

    def test_equal_blocks_show_no_error_unless_it_is_exact(self):
        equal = block_mean([0.5, 0.5])
        self.assertEqual((equal.error, equal.shows_error), (0, False))
        self.assertEqual(((equal - Mean(0.2)).freedom, (equal - Mean(0.2)).shows_error), (1, False))
        self.assertTrue((Mean(0.5) - Mean(0.2)).shows_error)
        self.assertTrue((Mean(0.5, 0.01) - equal).shows_error)
        self.assertFalse(block_mean([0.5]).shows_error)

    def test_a_resolution_is_the_least_error(self):
        equal, apart, one = block_mean([0.5, 0.5]), block_mean([0.4, 0.6]), block_mean([0.5])
        self.assertEqual(by_resolution(equal, 0.1), Mean(0.5, 0.1))
        self.assertEqual(by_resolution(apart, 0.1), apart)  # 12.7 errors of 0.1
        self.assertEqual(by_resolution(apart, 1.0).error, 1.0)
        self.assertTrue(np.isnan(by_resolution(one, 0.1).error))

    def test_rounding_to_steps_has_the_deviation_of_a_uniform_distribution(self):
        # The same number in both turns, as a surface by voxels. With this error, 5 % or fewer are wrongly apart from
        # truth
        random = np.random.default_rng(7)
        true = random.uniform(0, 10, 4000)
        found = [by_resolution(block_mean([round(one)] * 2), 1 / np.sqrt(12)) for one in true]
        self.assertAlmostEqual(np.std([one.value for one in found] - true), 1 / np.sqrt(12), delta=0.01)
        self.assertLess(np.mean([(one - Mean(exact)).sign != 0 for one, exact in zip(found, true)]), 0.05)

    def test_of_equal_means_one_in_twenty_has_a_sign(self):
        # Of means over two and three turns; with a limit of two errors it is one in five or more
        random = np.random.default_rng(7)
        for count in (2, 3):
            found = [block_mean(random.normal(0, 1, count)).sign != 0 for _ in range(4000)]
            self.assertAlmostEqual(np.mean(found), 0.05, delta=0.012)

    def test_a_series_has_its_blocks_freedom(self):
        found = mean_of_series(np.arange(10.0))
        self.assertEqual((found.value, found.freedom), (4.5, 4))


class Batches(unittest.TestCase):
    def test_values_count_by_their_time_steps(self):
        # 1 for 0.8 s in one step, then 3 for 0.1 s in two steps, in the first batch; 2 for 0.5 s and 4 for 0.45 s
        times, values = np.array([0.05, 0.85, 0.9, 0.95, 1.45, 1.9]), np.array([0.0, 1.0, 3.0, 3.0, 2.0, 4.0])
        np.testing.assert_allclose(batch_means(times, values, 0.1, 0.9, 2),
                                   [(0.8 * 1 + 0.1 * 3) / 0.9, (0.5 * 2 + 0.45 * 4) / 0.95], rtol=1e-12)

    def test_equal_values_have_an_error_of_zero(self):
        times = np.cumsum(np.random.default_rng(1).uniform(0.01, 0.1, 300))
        self.assertEqual(np.ptp(batch_means(times, np.full(300, 0.1 + 0.2), times[0], 1.0, 8)), 0)

    def test_without_a_value_a_batch_is_nan(self):
        self.assertTrue(np.isnan(batch_means(np.array([]), np.array([]), 0.0, 1.0, 2)).all())
        np.testing.assert_array_equal(batch_means(np.array([0.5]), np.array([2.0]), 0.0, 1.0, 2), [2, np.nan])


if __name__ == "__main__":
    unittest.main()
