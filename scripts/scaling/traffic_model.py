# SPDX-License-Identifier: BSD-3-Clause
"""Predicts the traffic and the imbalance of runs that were not measured, from the counters of measured rows.

Each phase and rank has its own formula. In phases that recur, the number of sweeps is a factor. The numbers of messages
and collectives are sums of 1, log2 P and P. The bytes are sums of sqrt(N/P) (borders), N/P (sites that move to another
rank), sqrt(N) (boundary), N (tables) and P. All coefficients are at least 0. The imbalance is 1 + g P/N, where g is the
number of points of a tile: ranks own whole tiles.
"""
import dataclasses
import math

import numpy as np

from .least_squares import nonnegative
from .model import BY_SWEEPS, Sample

FORMS = {
    "messages": {"1": lambda n, p: 1.0, "log2 P": lambda n, p: math.log2(p), "P": lambda n, p: float(p)},
    "bytes": {"sqrt(N/P)": lambda n, p: math.sqrt(n / p), "N/P": lambda n, p: n / p,
              "sqrt(N)": lambda n, p: math.sqrt(n), "N": lambda n, p: float(n), "P": lambda n, p: float(p)},
    "collectives": {"1": lambda n, p: 1.0, "log2 P": lambda n, p: math.log2(p), "P": lambda n, p: float(p)},
}
KINDS = tuple(FORMS)


def rounds_of(sample, phase):
    """Returns how often the phase recurs."""
    return sample.sweeps if phase in BY_SWEEPS else 1


def fit_count(samples, phase, kind):
    """Coefficients of one count by the names of its forms; errors are relative."""
    position = KINDS.index(kind)
    values = np.array([sample.traffic.get(phase, (0, 0, 0))[position] / rounds_of(sample, phase) for sample in samples])
    columns = {name: [form(sample.points, sample.ranks) for sample in samples] for name, form in FORMS[kind].items()}
    return nonnegative(columns, values, 1 / np.maximum(values, max(1e-3 * values.max(), 1e-9)))[0]


@dataclasses.dataclass(frozen=True)
class TrafficModel:
    """Counts by phase and kind; the points of a tile."""
    counts: dict
    granularity: float

    def sample(self, points, ranks, like):
        """A sample without times, of one thread a rank, with the sweeps of another one."""
        moved = points * like.moved / like.points
        imbalance = 1 + self.granularity * ranks / points if ranks > 1 else 1.0
        bare = Sample(points, ranks, 1, like.sweeps, moved, imbalance, 0.0, {}, {})
        traffic = {}
        for phase, kinds in self.counts.items():
            traffic[phase] = tuple(rounds_of(bare, phase) * sum(
                value * FORMS[kind][form](points, ranks) for form, value in kinds[kind].items()) for kind in KINDS)
        return dataclasses.replace(bare, traffic=traffic)


def fit_traffic(samples):
    """A TrafficModel from the samples on more than one rank; they must be some."""
    several = [sample for sample in samples if sample.ranks > 1]
    names = dict.fromkeys(name for sample in several for name in sample.traffic)
    counts = {name: {kind: fit_count(several, name, kind) for kind in KINDS} for name in names}
    share = np.array([sample.ranks / sample.points for sample in several])
    excess = np.array([sample.imbalance - 1 for sample in several])
    return TrafficModel(counts, float(max(0.0, share @ excess / (share @ share))))
