# SPDX-License-Identifier: BSD-3-Clause
"""The time of a run as a sum of terms, fitted to measured rows.

Each phase takes, on P ranks of t threads,

  T = a I W / (P t)              work that ranks and threads share; W: points x sweeps, or points
    + b I W / P                  work that the threads of a rank do not share
    + c I W / (P t)              the same work where all cores of the machine are busy: they share memory
    + r N^k                      work of each rank for itself; k: 0, 1/2 (the boundary) or 1 (tables of all tiles)
    + L M + B / bandwidth        messages and bytes of a rank
    + u B                        packing and unpacking of these bytes
    + L C log2 P + s C log2 P    collectives: their steps, and the wait for the slowest rank at each

N points, I the points of the fullest rank over the mean, M, B and C counted. L (latency) and bandwidth are those of the
Platform, given and never fitted. a, b, c, r, u, s >= 0 come from non-negative least squares, each phase for itself,
with errors relative to the time of the whole run. k is the one that fits best.
"""
import dataclasses
import math

import numpy as np

from .least_squares import nonnegative
from .record import OUTPUT, TRAFFIC

EXPONENTS = (0.0, 0.5, 1.0)
CLEARLY = 0.9  # a larger exponent must lower the residual to this share of that of a smaller one
BY_SWEEPS = ("sweeps", "measure", "sort", "stars")  # phases that recur: their work and traffic go with the sweeps


@dataclasses.dataclass(frozen=True)
class Platform:
    """What the ranks talk over: seconds from memory to memory, bytes per second."""
    name: str
    cores: int                # ranks of a node
    overhead: float           # of a message on both cores, LogGP's o
    latency: float            # within a node
    bandwidth: float          # of a rank, within a node
    network_latency: float
    network_bandwidth: float  # of a node: its ranks share it
    source: str

    def leaving(self, ranks):
        """Share of a rank's traffic with other nodes: nodes hold patches of the mesh, whose border goes as its root."""
        return 0.0 if ranks <= self.cores else 1 / math.sqrt(self.cores)

    def message(self, ranks):
        """Seconds of one message without its bytes."""
        away = self.leaving(ranks)
        return self.overhead + (1 - away) * self.latency + away * self.network_latency

    def byte(self, ranks):
        """Seconds of a byte."""
        away = self.leaving(ranks)
        return (1 - away) / self.bandwidth + away * self.cores / self.network_bandwidth

    def collective(self, ranks):
        """Seconds of a collective of few bytes: log2 P messages one after the other, as many as can within a node."""
        inside = math.log2(min(ranks, self.cores))
        outside = math.log2(ranks) - inside
        return inside * (self.overhead + self.latency) + outside * (self.overhead + self.network_latency)


CLUSTER = (64, 0.4e-6, 0.3e-6, 15e9, 2e-6, 12.5e9)
PLATFORMS = {
    "simulated": Platform("simulated", *CLUSTER, "that of scripts/cluster/fat_tree.xml: 64 cores a node, InfiniBand"),
    "slurm": Platform("slurm", *CLUSTER, "assumed: 64 cores a node, 100 Gbit/s InfiniBand"),
    "local": Platform("local", 10**9, 0.4e-6, 0.3e-6, 5e9, 2e-6, 12.5e9, "assumed: shared memory between processes"),
}


@dataclasses.dataclass(frozen=True)
class Sample:
    """One row as the model sees it; traffic by phase as (messages, bytes, collectives) of one rank."""
    points: float
    ranks: int
    threads: int
    sweeps: int        # of all stages
    moved: float       # points x sweeps, without those that slept where that is counted
    imbalance: float
    full: float        # 1 where all cores of the machine are busy, else 0
    traffic: dict
    seconds: dict      # by phase; empty for a prediction

    @property
    def total(self):
        return sum(self.seconds.values())

    def work(self, phase):
        """Points that the phase handles in all."""
        return self.moved if phase in BY_SWEEPS else self.points

    @property
    def depth(self):
        """Steps of a collective."""
        return math.log2(self.ranks)


def sample_of(row, machine_cores):
    """A row of the tables as a sample; output is no part of the model."""
    ranks = row["ranks"]
    phases = {name: phase for name, phase in row["phases"].items() if name not in OUTPUT}
    traffic = {name: tuple(phase[key] / (1 if key == "collectives" else ranks) for key in TRAFFIC)
               for name, phase in phases.items()}
    full = float(row["backend"] == "local" and row["cores"] > 1 and row["cores"] >= machine_cores)
    swept = row["counters"].get("run", {}).get("sites_swept", {}).get("sum", row["point_sweeps"])
    return Sample(row["points"], ranks, row["threads"], max(1, row["iterations"]), swept or row["points"],
                  max(1.0, row["imbalance"]), full, traffic, {name: phase["avg"] for name, phase in phases.items()})


def given_terms(sample, phase, platform):
    """Seconds of the terms that need no fit."""
    if sample.ranks == 1:
        return {}
    messages, size, collectives = sample.traffic.get(phase, (0, 0, 0))
    return {"messages": platform.message(sample.ranks) * messages, "bytes": platform.byte(sample.ranks) * size,
            "collectives": platform.collective(sample.ranks) * collectives}


def fitted_columns(sample, phase, exponent):
    """What stands beside each coefficient."""
    _, size, collectives = sample.traffic.get(phase, (0, 0, 0))
    share = sample.imbalance * sample.work(phase) / sample.ranks
    alone = sample.ranks == 1
    return {"work": share / sample.threads, "threads": share, "memory": share / sample.threads * sample.full,
            "replicated": sample.points**exponent, "packing": 0 if alone else size,
            "waiting": 0 if alone else collectives * sample.depth}


@dataclasses.dataclass(frozen=True)
class PhaseModel:
    """One phase: coefficients by term, and the exponent of the replicated work."""
    name: str
    coefficients: dict
    exponent: float

    def terms(self, sample, platform):
        """Seconds by term. Work is split: what imbalance adds to it stands apart."""
        columns = fitted_columns(sample, self.name, self.exponent)
        terms = {term: coefficient * columns[term] for term, coefficient in self.coefficients.items()}
        waste = 1 - 1 / sample.imbalance
        terms["imbalance"] = waste * sum(terms.get(term, 0) for term in ("work", "memory", "threads"))
        for term in ("work", "memory", "threads"):
            if term in terms:
                terms[term] *= 1 - waste
        for term, seconds in given_terms(sample, self.name, platform).items():
            terms[term] = terms.get(term, 0) + seconds
        return terms


def solve(samples, phase, platform, exponent):
    """Coefficients and residual of one phase with a given exponent."""
    rows = [fitted_columns(sample, phase, exponent) for sample in samples]
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    if len({sample.threads for sample in samples}) == 1:
        del columns["threads"]  # the same as the work
    target = [sample.seconds.get(phase, 0.0) - sum(given_terms(sample, phase, platform).values()) for sample in samples]
    return nonnegative(columns, target, np.array([1 / sample.total for sample in samples]))


def fit_phase(samples, phase, platform):
    """The model of one phase; the smallest exponent that fits about as well as any."""
    sizes = len({sample.points for sample in samples})
    best = None
    for exponent in EXPONENTS if sizes > 1 else EXPONENTS[:1]:
        coefficients, residual = solve(samples, phase, platform, exponent)
        if best is None or residual < CLEARLY * best[0]:
            best = residual, PhaseModel(phase, coefficients, exponent)
    return best[1]


@dataclasses.dataclass(frozen=True)
class TimeModel:
    """All phases of a run on one platform."""
    platform: Platform
    phases: tuple

    def terms(self, sample):
        """Seconds by (phase, term)."""
        return {(phase.name, term): seconds for phase in self.phases
                for term, seconds in phase.terms(sample, self.platform).items()}

    def seconds(self, sample):
        """Of the whole run, without output."""
        return sum(self.terms(sample).values())


def fit(samples, platform):
    """A TimeModel from samples of one config and method on one platform."""
    names = dict.fromkeys(name for sample in samples for name in sample.seconds)
    return TimeModel(platform, tuple(fit_phase(samples, name, platform) for name in names))
