# SPDX-License-Identifier: BSD-3-Clause
"""The time of a run as a sum of terms, fitted to measured rows.

Each phase takes, on P ranks of t threads, a sum of some of these terms:

  work       a I W / (P t)     what ranks and threads share; W: points x sweeps, or points
  threads    a I W / P         work that the threads of a rank do not share
  memory     a I W / (P t)     the same where all cores of the machine are busy: they share memory
  once       a                 what each rank does for itself, whatever the size
  boundary   a sqrt(N)         ... for the whole boundary
  tables     a N               ... for tables of the whole mesh
  packing    a B               handling of the bytes that are sent
  waiting    a C log2 P        for the slowest rank at each collective
  ranks      a C P             collectives whose data grow with the ranks
  messages, bytes, collectives: latency x M, B / bandwidth, latency x C log2 P

N points, I the points of the fullest rank over the mean; M, B and C counted. Latency and bandwidth are those of the
Platform, given and never fitted. The factors a >= 0 come from non-negative least squares, each phase for itself, with
errors relative to the time of the whole run. A term is taken only if it lowers the error by LEAST_GAIN, some by twice
that (PRICES): noise must not be carried on to 10^4 ranks.
"""
import dataclasses
import math

import numpy as np

from .least_squares import nonnegative
from .record import OUTPUT, TRAFFIC

LEAST_GAIN = 0.004  # of the time of a run, root mean square over the rows: about what medians of five runs are good for
PRICES = {"tables": 2, "ranks": 2}  # factor on LEAST_GAIN for terms that grow fast with N or P
FAR = 1e9  # gains that no first term fails to bring
WORK = ("work", "threads", "memory")  # terms that imbalance lengthens
BY_SWEEPS = ("sweeps", "measure", "sort")  # phases that recur: their work and traffic go with the sweeps


@dataclasses.dataclass(frozen=True)
class Platform:
    """The medium of the messages: seconds from memory to memory, bytes per second."""
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
    """A row of the tables as a sample; output is not part of the model."""
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


def fitted_columns(sample, phase):
    """Returns what each factor is multiplied by."""
    _, size, collectives = sample.traffic.get(phase, (0, 0, 0)) if sample.ranks > 1 else (0, 0, 0)
    share = sample.imbalance * sample.work(phase) / sample.ranks
    return {"work": share / sample.threads, "threads": share, "memory": share / sample.threads * sample.full,
            "once": 1.0, "boundary": math.sqrt(sample.points), "tables": sample.points,
            "packing": size, "waiting": collectives * sample.depth, "ranks": collectives * sample.ranks}


@dataclasses.dataclass(frozen=True)
class PhaseModel:
    """One phase: factors by term."""
    name: str
    factors: dict

    def terms(self, sample, platform):
        """Seconds by term. What imbalance adds to the work stands apart."""
        columns = fitted_columns(sample, self.name)
        terms = {term: factor * columns[term] for term, factor in self.factors.items()}
        waste = 1 - 1 / sample.imbalance
        terms["imbalance"] = waste * sum(terms.get(term, 0) for term in WORK)
        terms |= {term: (1 - waste) * terms[term] for term in WORK if term in terms}
        return terms | given_terms(sample, self.name, platform)


def fit_phase(samples, phase, platform):
    """The model of one phase: terms are taken one after the other, the one that helps most first."""
    rows = [fitted_columns(sample, phase) for sample in samples]
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    if len({sample.threads for sample in samples}) == 1:
        del columns["threads"]  # the same as the work
    if len({sample.points for sample in samples}) == 1:
        del columns["boundary"], columns["tables"]  # the same as `once`
    target = [sample.seconds.get(phase, 0.0) - sum(given_terms(sample, phase, platform).values()) for sample in samples]
    weights = np.array([1 / sample.total for sample in samples])
    least_gain = LEAST_GAIN * math.sqrt(len(samples))
    taken, best = [], ({}, FAR * least_gain)
    while len(taken) < len(columns):
        trials = [(nonnegative({term: columns[term] for term in [*taken, name]}, target, weights), name)
                  for name in columns if name not in taken]
        found, name = min(trials, key=lambda trial: trial[0][1] + PRICES.get(trial[1], 1) * least_gain)
        if found[1] > best[1] - PRICES.get(name, 1) * least_gain:
            break
        taken.append(name)
        best = found
    return PhaseModel(phase, best[0])


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
