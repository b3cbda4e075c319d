#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the model of the time in the scaling harness: it finds the known terms of invented rows."""
import dataclasses
import math
import random
import unittest

from made_runs import made_run
from scaling import model, model_report, summary, traffic_model


class Model(unittest.TestCase):
    PLATFORM = model.PLATFORMS["simulated"]

    def sample(self, points, ranks, threads=1):
        """A sample of two phases whose terms are known."""
        messages, size, collectives = 8.0 * math.log2(ranks) * 10, 40 * math.sqrt(points / ranks) * 10, 3.0 * 10
        traffic = {"sweeps": (messages, size, collectives), "boundary": (0.0, 0.0, 2.0)}
        imbalance = 1 + 300 * (ranks > 1) * ranks / points
        bare = model.Sample(points, ranks, threads, 10, 10 * points, imbalance, 0.0, traffic, {})
        sweeps = 30e-9 * bare.imbalance * 10 * points / (ranks * threads) + sum(
            model.given_terms(bare, "sweeps", self.PLATFORM).values()) + (0 if ranks == 1 else 1e-9 * size)
        boundary = 2e-6 * math.sqrt(points) + sum(model.given_terms(bare, "boundary", self.PLATFORM).values())
        return dataclasses.replace(bare, seconds={"sweeps": sweeps, "boundary": boundary})

    def samples(self):
        return [self.sample(points, ranks) for points in (1e5, 1e6) for ranks in (1, 4, 16)]

    def test_known_terms_come_back(self):
        fitted = model.fit(self.samples(), self.PLATFORM)
        by_name = {phase.name: phase for phase in fitted.phases}
        self.assertAlmostEqual(by_name["sweeps"].factors["work"], 30e-9, delta=1e-11)
        self.assertAlmostEqual(by_name["sweeps"].factors["packing"], 1e-9, delta=2e-11)
        self.assertEqual(list(by_name["boundary"].factors), ["boundary"])
        self.assertAlmostEqual(by_name["boundary"].factors["boundary"], 2e-6, delta=1e-8)

    def test_ranks_that_it_has_not_seen(self):
        fitted = model.fit(self.samples(), self.PLATFORM)
        for points, ranks in ((1e6, 256), (1e8, 1024)):
            unseen = self.sample(points, ranks)
            self.assertAlmostEqual(fitted.seconds(unseen) / unseen.total, 1, delta=0.02)

    def test_rows_left_out_of_noisy_ones(self):
        noise = random.Random(1)
        samples = [dataclasses.replace(sample, seconds={name: seconds * (1 + 0.03 * noise.gauss(0, 1))
                                                        for name, seconds in sample.seconds.items()})
                   for points in (1e5, 1e6) for ranks in (1, 4, 16, 64) for sample in [self.sample(points, ranks)]]
        for seconds, sample in zip(model_report.left_out(samples, self.PLATFORM), samples):
            self.assertAlmostEqual(seconds / sample.total, 1, delta=0.12)

    def test_counts_are_carried_on(self):
        found = traffic_model.fit_traffic(self.samples())
        unseen, guessed = self.sample(1e7, 1024), found.sample(1e7, 1024, self.samples()[0])
        self.assertAlmostEqual(found.granularity, 300, delta=3)
        for value, expected in zip(guessed.traffic["sweeps"], unseen.traffic["sweeps"]):
            self.assertAlmostEqual(value / expected, 1, delta=0.02)
        self.assertAlmostEqual(guessed.moved, unseen.moved)

    def test_terms_add_up_and_imbalance_stands_apart(self):
        fitted, sample = model.fit(self.samples(), self.PLATFORM), self.sample(1e5, 64)
        terms = fitted.terms(sample)
        self.assertAlmostEqual(sum(terms.values()), fitted.seconds(sample))
        self.assertAlmostEqual(terms["sweeps", "imbalance"] / terms["sweeps", "work"], sample.imbalance - 1)

    def test_threads_that_do_not_share_all_work(self):
        samples = [dataclasses.replace(self.sample(1e5, 1, threads), seconds={"sweeps": 1e-3 * (1 + 1 / threads)})
                   for threads in (1, 2, 4)]
        phase, = model.fit(samples, self.PLATFORM).phases
        self.assertAlmostEqual(phase.factors["threads"], phase.factors["work"])

    def test_report_holds_rows_out_and_predicts(self):
        rows, _ = summary.rows_of([made_run(ranks, 1, 1 / ranks + 0.01, backend="simulated", points=100000)
                                   for ranks in (1, 4, 16, 64, 256)])
        text = model_report.report(rows, 1)
        self.assertEqual(text.count("| held out |"), 2)
        self.assertIn("(bar: 25 %)", text)
        self.assertIn("Assumptions of the predictions", text)
        self.assertIn("| 1e+10 | 10,000 |", text)
        self.assertEqual([row["ranks"] for row in model_report.held_out(rows)], [64, 256])

    def test_few_rows_are_no_model(self):
        rows, _ = summary.rows_of([made_run()])
        self.assertIn("too few for a model", model_report.report(rows, 1))


if __name__ == "__main__":
    unittest.main()
