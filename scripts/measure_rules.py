#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the effect of each number in src/*/rules.hpp: makes meshes with 1.25 and 0.8 times the number.

The script builds a copy of the sources whose program reads the numbers from the environment when it starts. Numbers
that the compiler must know, such as sizes of arrays, stay as they are and get no line. The script then changes one
number at a time, and meshes some cases that use all modules, with one thread. It writes a CSV file: one line for each
number and direction, with the largest differences over the cases. It writes a change of the processor time only if the
change exceeds TIMES, and if it exceeds TIMES again in runs that alternate with runs of the unchanged numbers.

Usage: measure_rules.py [--work DIR] [--only WORD] [-o src/rules_effects.csv]
  --work DIR    build the copy here (default: build/rules)
  --only WORD   measure only the numbers whose full name contains WORD; the other lines of the file stay
The script takes about 40 minutes on two cores, 3 of them for the build.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import rules_table  # noqa: E402  (found by the line above)

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLUMNS = ("number", "factor", "same_meshes", "mean_alpha", "largest_alpha", "points", "time", "failed")
EFFECTS = ROOT / rules_table.EFFECTS
CASES = {  # rules_table.CASES of them; name: config and overrides; together they use every module
    "square": ["square.ini", "meshing.points=8000", "sizing.type=uniform"],
    "coast": ["coast.ini", "meshing.points=6000"],
    "spade": ["spade.ini", "meshing.points=5000", "meshing.method=hybrid"],
    "graded": ["size_expression.ini", "meshing.points=8000"],
    "torus": ["torus_hole.ini", "meshing.points=4000"],
    "few": ["boolean.ini", "meshing.points=700"],
}
TIMES = (0.87, 1.15)  # of the time with the numbers as they are: between them it is noise
REPETITIONS = 3
MANY_LINES = 40  # this many lines show how much simultaneous runs slow each other down
SIMPLE = {"double": "double", "float": "float", "int": "int", "std::size_t": "std::size_t", "GlobalId": "GlobalId",
          "LocalIndex": "LocalIndex", "std::int64_t": "std::int64_t", "std::ptrdiff_t": "std::ptrdiff_t",
          "std::int32_t": "std::int32_t", "std::uint32_t": "std::uint32_t", "std::uint64_t": "std::uint64_t"}
TUNED = """// Made by scripts/measure_rules.py: a number that the environment may set (TRIME_RULE=name factor).
#pragma once
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <type_traits>
namespace trime {
template <class T> inline T tuned(const char* name, T value) {
  const char* set = std::getenv("TRIME_RULE");
  const std::size_t n = std::strlen(name);
  if (!set || std::strncmp(set, name, n) != 0 || set[n] != ' ') return value;
  const double factor = std::atof(set + n);
  if constexpr (std::is_floating_point_v<T>) return static_cast<T>(value * factor);
  const double changed = static_cast<double>(value) * factor;
  return static_cast<T>(factor > 1 ? std::ceil(changed) : std::floor(changed));
}
}
"""


def patch(tree, numbers, fixed):
    """Lets the environment set all numbers but the fixed ones; returns the names that it can set."""
    names = []
    for path in sorted({number.where.rpartition(":")[0] for number in numbers}):
        text = (ROOT / path).read_text(encoding="utf-8")
        for number in (n for n in numbers if n.where.startswith(path + ":")):
            name = number.full_name()
            pattern = re.compile(rf"static constexpr ([\w:]+) {number.name} = ([^;]+);")
            match = pattern.search(text)
            if not match or match.group(1) not in SIMPLE or name in fixed:
                continue
            kind = match.group(1)
            tuned = f'trime::tuned<{kind}>("{name}", {match.group(2)})'
            text = pattern.sub(f"static inline const {kind} {number.name} = {tuned};", text, count=1)
            names.append(name)
        target = tree / path
        target.write_text(text.replace("#pragma once", '#pragma once\n#include "core/tuned.hpp"', 1), encoding="utf-8")
    return names


def build(work, numbers):
    """Builds the copy. A number that the compiler must know stops it: then that number stays fixed. Returns the
    program and the names that can be set."""
    tree, target, fixed = work / "tree", work / "build", set()
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-coz", "--exclude-standard", "CMakeLists.txt",
                             "CMakePresets.json", "LICENSE", "CHANGELOG.md", "README.md", "jobs", "configs", "src",
                             "include", "scripts"], capture_output=True, check=True, text=True)
    for name in filter(None, listed.stdout.split("\0")):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, tree / name)
    (tree / "src/core/tuned.hpp").write_text(TUNED, encoding="utf-8")
    patch(tree, numbers, fixed)
    subprocess.run(["cmake", "-S", tree, "-B", target, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DTRIME_BUILD_TESTS=OFF", "-DTRIME_BUILD_BENCHMARKS=OFF", "-DTRIME_BUILD_EXAMPLES=OFF"],
                   check=True, stdout=subprocess.DEVNULL)
    for _ in range(20):
        names = patch(tree, numbers, fixed)
        done = subprocess.run(["cmake", "--build", target, "--target", "trime_mpi", "--", "-k", "0"],
                              capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return target / "trime_mpi", names
        missing = set(re.findall(r"\b(\w+Rules|\w+Options)::(\w+)", done.stdout)) | {
            ("", word) for word in re.findall(r"‘(\w+)’ (?:is not usable|was not initialized)", done.stdout)} | {
            ("", word) for word in re.findall(r"the value of ‘(?:\w+::)*(\w+)’", done.stdout)}
        more = {name for name in names for struct, word in missing
                if name.endswith(f"::{word}") and (not struct or f"::{struct}::" in name)} - fixed
        if not more:
            sys.exit(done.stdout[-8000:])
        fixed |= more
        print(f"{len(fixed)} numbers that the compiler must know", flush=True)
    sys.exit("The copy does not build.")


def run(program, name, factor, case, directory):
    """Runs one case; returns (hash, mean alpha, largest alpha, points, user seconds), or None if it failed."""
    config, *overrides = CASES[case]
    environment = dict(os.environ, OMP_NUM_THREADS="1", TRIME_RULE=f"{name} {factor}")
    command = [program, ROOT / "configs" / config, *overrides, f"output.directory={directory}", f"output.name={case}",
               "output.overwrite=true", "output.formats=text", "--log-level=info"]
    try:
        done = subprocess.run(["/usr/bin/env", "bash", "-c", 'TIMEFORMAT="user %U"; time "$@"', "bash",
                               *map(str, command)],
                              capture_output=True, text=True, env=environment, timeout=120, check=False)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0:
        return None
    text = done.stdout
    alpha = re.search(r"^ *alpha +([\d.]+) +([\d.]+) +([\d.]+)", text, re.M)
    return (re.search(r"Mesh hash +(\w+)", text).group(1), float(alpha.group(2)), float(alpha.group(3)),
            int(re.search(r"^(\d+) points, ", text, re.M).group(1)),
            float(re.search(r"user ([\d.]+)", done.stderr).group(1)))


def measure(program, name, factor, base):
    """Returns the line of a number: the largest differences over all cases."""
    with tempfile.TemporaryDirectory() as directory:
        results = {case: run(program, name, factor, case, directory) for case in CASES}
    failed = [case for case, result in results.items() if result is None]
    both = [(result, base[case]) for case, result in results.items() if result]

    def largest(values):
        return max(values, key=abs, default=0)

    time = sum(r[4] for r, _ in both) / max(1e-9, sum(b[4] for _, b in both))
    return {"number": name, "factor": factor, "same_meshes": sum(r[0] == b[0] for r, b in both),
            "mean_alpha": f"{largest([r[1] - b[1] for r, b in both]):+.4f}",
            "largest_alpha": f"{largest([r[2] - b[2] for r, b in both]):+.3f}",
            "points": f"{largest([r[3] / b[3] - 1 for r, b in both]):+.4f}", "time": f"{time:.2f}",
            "failed": " ".join(failed)}


def is_noise(time):
    """True if so small a change of the time has no meaning."""
    return TIMES[0] <= time <= TIMES[1]


def repeated_time(program, row):
    """Measures the time of a line again, alternately with the unchanged numbers. Returns None as soon as one difference
    is noise."""
    cases, times = [case for case in CASES if case not in row["failed"].split()], []
    for _ in range(REPETITIONS):
        seconds = {}
        for name in ("none", row["number"]):
            with tempfile.TemporaryDirectory() as directory:
                results = [run(program, name, row["factor"], case, directory) for case in cases]
            seconds[name] = sum(result[4] for result in results if result)
        times.append(seconds[row["number"]] / max(1e-9, seconds["none"]))
        if is_noise(times[-1]):
            return None
    return statistics.median(times)


def settle_times(program, rows, pool):
    """Leaves the time only in those of the lines where it stays changed. Most others show how much all runs were
    slowed down by each other."""
    usual = statistics.median(float(row["time"]) for row in rows) if len(rows) >= MANY_LINES else 1
    suspects = [row for row in rows if not is_noise(float(row["time"]) / usual)]
    times = pool.map(lambda row: repeated_time(program, row), suspects)
    for row in rows:
        row["time"] = ""
    for row, time in zip(suspects, times):
        row["time"] = f"{time:.2f}" if time else ""
        print(f"{row['number']} {row['factor']}: time {row['time'] or 'as before'}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build" / "rules",
                        help="build the copy here (default: build/rules)")
    parser.add_argument("--only", default="", metavar="WORD",
                        help="measure only the numbers whose full name contains WORD; the other lines of the file stay")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=EFFECTS,
                        help="the CSV file (default: src/rules_effects.csv)")
    options = parser.parse_args()
    numbers, complaints = rules_table.read_tree(ROOT)
    if complaints:
        sys.exit("\n".join(complaints))
    program, names = build(options.work, numbers)
    names = [name for name in names if options.only in name]
    if not names:
        sys.exit(f"no number that can be changed has '{options.only}' in its name")
    with tempfile.TemporaryDirectory() as directory:
        base = {case: run(program, "none", 1, case, directory) for case in CASES}
    for case, result in base.items():
        if result is None:
            sys.exit(f"case {case} fails with the numbers as they are")
    kept = {}
    if options.output.exists():
        with options.output.open(encoding="utf-8", newline="") as file:
            kept = {(row["number"], row["factor"]): row for row in csv.DictReader(file)}
    jobs = [(name, factor) for name in names for factor in (1.25, 0.8)]
    with concurrent.futures.ThreadPoolExecutor(max_workers=max(1, (os.cpu_count() or 2))) as pool:
        rows = []
        for row in pool.map(lambda job: measure(program, *job, base), jobs):
            rows.append(row)
            print(" ".join(str(row[column]) for column in COLUMNS), flush=True)
        settle_times(program, rows, pool)
    kept.update({(row["number"], str(row["factor"])): row for row in rows})
    known = {number.full_name() for number in numbers}
    with options.output.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept[key] for key in sorted(kept) if key[0] in known)


if __name__ == "__main__":
    main()
