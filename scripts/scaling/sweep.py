# SPDX-License-Identifier: BSD-3-Clause
"""Reads an ini file of sweeps: every section except [harness] is a sweep over methods, points, ranks and threads.

The table KEYS below lists the keys; sweeps/default.ini shows them in use.
"""
import configparser
import dataclasses
import difflib
import pathlib
import re
import shlex

from .errors import ROOT, UsageError

SWEEPS = pathlib.Path(__file__).resolve().parent / "sweeps"
METHODS = ("distmesh", "cvd", "hybrid")
STOPS = ("fixed", "rule")  # after a fixed number of sweeps: the machine; by the stop rule: what a user waits for

# key: default; None: must be given
KEYS = {
    "kind": None,          # strong: `points` are those of the mesh; weak: those of one core
    "config": None,        # of trime_mpi; relative to the ini, else to the top of the source tree
    "points": None,
    "cases": None,         # ranks x threads, as 1x1 1x2 2x1, or one of the words of `layouts`
    "methods": " ".join(METHODS),
    "stops": " ".join(STOPS),
    "sweeps": "12",        # for the stop `fixed`: meshing.max_sweeps
    "output": "no",        # yes: the mesh file is written, and its seconds stand apart
    "options": "",         # section.key=value for all runs
    "variants": "",        # lines `NAME: section.key=value ...`, each a separate sweep
    "beside": "",          # cases that run on this machine, too, where the backend is another one
    "reference": "",       # name in reference.csv, whose published times of TriMe++ are shown, too
}
HARNESS_KEYS = {
    "repeats": "5",        # runs of a case that count
    "warm_ups": "1",       # runs of a case before them that do not
    "limit": "3600",       # seconds after which a run counts as failed
}


@dataclasses.dataclass(frozen=True)
class Case:
    """One mesh on one number of ranks and threads."""
    sweep: str
    kind: str
    config: str           # relative to the top of the source tree, where it lies in it
    method: str
    variant: str
    stop: str
    points_asked: int     # of the whole mesh
    points_per_core: int  # weak: the same in all cases; strong: 0
    ranks: int
    threads: int
    options: tuple        # section.key=value, those of method, variant and stop included
    output: bool
    backend: str
    reference: str

    @property
    def cores(self):
        return self.ranks * self.threads

    @property
    def layout(self):
        """As tables show it."""
        return f"{self.ranks} x {self.threads}"

    @property
    def label(self):
        """One line for a progress report."""
        variant = f" {self.variant}" if self.variant else ""
        return f"{self.sweep}{variant}, {self.method}, {self.stop}, {self.points_asked:.3g} points, {self.layout}"


@dataclasses.dataclass(frozen=True)
class Plan:
    """All cases of an ini and how often they run."""
    cases: tuple
    repeats: int
    warm_ups: int
    limit: float


def layouts(word, nodes):
    """Returns the cases (ranks, threads) that a word stands for, on nodes with these numbers of cores, e.g. [64, 64].

    powers: 1, 2, 4, ... and all cores, each as ranks only, as threads only, and as half of the doublings each. ranks,
    threads: only these; threads from 1 to the cores of a node. Returns None for other words.
    """
    cores, node = sum(nodes), min(nodes)
    counts = [2**k for k in range(cores.bit_length()) if 2**k < cores] + [cores]
    if word == "ranks":
        return [(count, 1) for count in counts]
    if word == "threads":
        return [(1, threads) for threads in range(1, node + 1)]
    if word != "powers":
        return None
    found = []
    for count in counts:
        half = 1 << ((count - 1).bit_length() + 1) // 2  # the least power of two whose square reaches count
        for threads in (1, half, count):
            if count % threads == 0 and threads <= node and (count // threads, threads) not in found:
                found.append((count // threads, threads))
    return found


def parse_layouts(text, nodes, where):
    """'1x1 2x4' or a word as pairs (ranks, threads)."""
    found = []
    for part in re.split(r"[,\s]+", text.strip()):
        match = re.fullmatch(r"([1-9]\d*)x([1-9]\d*)", part)
        pairs = [(int(match[1]), int(match[2]))] if match else layouts(part, nodes or [1])
        if not match and pairs and not nodes:
            raise UsageError(f"{where}: '{part}' needs the cores of the nodes; say --nodes 4x64, or name the cases")
        if pairs is None:
            raise UsageError(f"{where}: expected cases like 1x1 2x4, or powers, ranks or threads; found '{part}'")
        found += [pair for pair in pairs if pair not in found]
    return found


def parse_points(text, where):
    """'1e5 2e6' as whole numbers."""
    found = []
    for part in re.split(r"[,\s]+", text.strip()):
        try:
            value = float(part)
        except ValueError:
            value = 0
        if not 1 <= value < 1e18:
            raise UsageError(f"{where}: expected numbers of points like 1e5 1e6, found '{part}'")
        found.append(int(value))
    return found


def parse_words(text, allowed, where):
    """Returns the words of a list. Each word must be known."""
    words = re.split(r"[,\s]+", text.strip())
    for word in words:
        if word not in allowed:
            raise UsageError(f"{where}: expected some of {', '.join(allowed)}; found '{word}'")
    return words


def parse_count(text, least, where):
    """A whole number."""
    if not re.fullmatch(r"\d+", text.strip()) or int(text) < least:
        raise UsageError(f"{where}: expected a whole number from {least} on, found '{text}'")
    return int(text)


def parse_options(text, where):
    """section.key=value, separated by blanks; values with blanks in quotes."""
    options = tuple(shlex.split(text))
    for option in options:
        if not re.fullmatch(r"[\w.]+\.\w+=.*", option):
            raise UsageError(f"{where}: expected section.key=value, found '{option}'")
    return options


def parse_variants(text, where):
    """Lines `NAME: options` as pairs; without lines one variant without a name."""
    found = []
    for line in filter(None, (line.strip() for line in text.splitlines())):
        name, colon, options = line.partition(":")
        if not colon:
            raise UsageError(f"{where}: expected NAME: section.key=value ..., found '{line}'")
        found.append((name.strip(), parse_options(options, where)))
    return found or [("", ())]


def read_section(parser, path, section, keys):
    """The keys of a section with defaults; unknown and missing ones are errors."""
    values = dict(parser[section])
    for key in values:
        if key not in keys:
            near = difflib.get_close_matches(key, keys, 1)
            guess = f"; did you mean '{near[0]}'?" if near else ""
            raise UsageError(f"{path}: unknown key '{key}' in [{section}]{guess}")
    for key, default in keys.items():
        if values.setdefault(key, default) is None:
            raise UsageError(f"{path}: [{section}] has no '{key}'")
    return values


def find_config(text, path):
    """A config relative to the ini, else to the top of the source tree."""
    for place in (path.parent / text, ROOT / text):
        if place.is_file():
            place = place.resolve()
            return str(place.relative_to(ROOT) if place.is_relative_to(ROOT) else place)
    raise UsageError(f"{path}: there is no config {text}, neither next to the ini nor in {ROOT}")


def cases_of(section, values, path, backend, nodes, overrides):
    """All cases of one sweep."""
    where = f"{path}, [{section}]"
    kind, = parse_words(values["kind"], ("strong", "weak"), f"{where} kind")
    output, = parse_words(values["output"], ("yes", "no"), f"{where} output")
    config = find_config(values["config"], path)
    sweeps = parse_count(values["sweeps"], 1, f"{where} sweeps")
    pairs = [(backend, pair) for pair in parse_layouts(values["cases"], nodes, f"{where} cases")]
    if values["beside"] and backend != "local":
        pairs += [("local", pair) for pair in parse_layouts(values["beside"], nodes, f"{where} beside")]
    common = parse_options(values["options"], f"{where} options") + overrides
    found = []
    for points in parse_points(values["points"], f"{where} points"):
        for name, variant in parse_variants(values["variants"], f"{where} variants"):
            for method in parse_words(values["methods"], METHODS, f"{where} methods"):
                for stop in parse_words(values["stops"], STOPS, f"{where} stops"):
                    options = (f"meshing.method={method}",) + common + variant
                    if stop == "fixed":
                        options += (f"meshing.max_sweeps={sweeps}",)
                    for on, (ranks, threads) in pairs:
                        size = (points * ranks * threads, points) if kind == "weak" else (points, 0)
                        found.append(Case(section, kind, config, method, name, stop, *size, ranks, threads, options,
                                          output == "yes", on, values["reference"]))
    return found


def read_plan(path, backend, nodes, changes=None, overrides=(), only="", kind=""):
    """All cases of an ini.

    `changes` replaces values of all sections (by key). `overrides` are more options of trime_mpi. `only` keeps sections
    whose name contains it, `kind` those of that kind. Raises UsageError, also where no case is left.
    """
    changes = {key: value for key, value in (changes or {}).items() if value is not None}
    parser = configparser.ConfigParser(interpolation=None, inline_comment_prefixes=(";", "#"), default_section="")
    try:
        with open(path, encoding="utf-8") as stream:
            parser.read_file(stream)
    except (OSError, UnicodeDecodeError, configparser.Error) as error:
        raise UsageError(f"{path}: {error}") from error
    if not parser.has_section("harness"):
        parser.add_section("harness")
    parser["harness"].update({key: value for key, value in changes.items() if key in HARNESS_KEYS})
    harness = read_section(parser, path, "harness", HARNESS_KEYS)
    cases = []
    for section in parser.sections():
        if section != "harness" and only in section:
            parser[section].update({key: value for key, value in changes.items() if key in KEYS})
            values = read_section(parser, path, section, KEYS)
            if kind in ("", values["kind"]):
                cases += cases_of(section, values, pathlib.Path(path), backend, nodes, tuple(overrides))
    if not cases:
        raise UsageError(f"{path}: an empty sweep: no section" + (f" of kind {kind}" if kind else "")
                         + (f" with '{only}' in its name" if only else "") + " asks for a run")
    return Plan(tuple(cases), parse_count(harness["repeats"], 1, f"{path}, [harness] repeats"),
                parse_count(harness["warm_ups"], 0, f"{path}, [harness] warm_ups"),
                parse_count(harness["limit"], 1, f"{path}, [harness] limit"))
