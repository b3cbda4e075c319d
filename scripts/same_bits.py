#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every build of the program makes the same meshes: other compilers, optimisation levels and vector
instructions, MPICH, and AArch64.

The script builds the program in several ways, meshes a few small configs with each build, and prints the hashes of the
meshes as a table in Markdown. A row that differs from the first one says so. scripts/packages.sh lists the packages.

  scripts/same_bits.py                                    # all builds, in a temporary directory
  scripts/same_bits.py --builds gcc-O3,clang-O2 --keep DIR
  scripts/same_bits.py --builds aarch64 --keep DIR        # also builds gcc-O3, the first row of every table
  scripts/same_bits.py --program ci=build/ci/trime_mpi --program mpich=build/mpich/trime_mpi     # builds nothing

Debian's cross compiler makes the program for AArch64, and qemu-user runs it. The script downloads its libraries as
Debian packages (130 MB), and unpacks them into DIR/sysroot. It installs nothing, and needs no rights of root.

A build takes 5 to 10 minutes on one core, or one minute if ccache holds all objects; --jobs N builds on N cores. The
runs of a build take 10 s, those of AArch64 a minute.

Exit codes: 0 all hashes are equal, 1 some differ, 2 bad use, 4 a build or a run failed.
"""
import argparse
import dataclasses
import functools
import json
import os
import pathlib
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile

from foreign_build import ForeignError, foreign_arguments, foreign_run

ROOT = pathlib.Path(__file__).resolve().parent.parent
POINTS = 2000

# Every function of formulas, in sizes and in a shape.
SIZE = """[shape]
geometry = plate
[shape.plate]
type = rectangle
x_min = 0.1
x_max = 0.9
y_min = 0.2
y_max = 0.8
[sizing]
type = expression
expression = 0.4 + exp(-3*x)*sin(9*y)^2 + 0.3*x^1.7 + 0.1*log(1+x+y) + 0.05*tanh(4*x-2)*cos(30*y) + atan(x/y)/20
"""
REGION = """[shape]
geometry = difference(flower, hole)
[shape.flower]
type = expression
sdf = sqrt((x-0.5)^2+(y-0.5)^2) - 0.3 - 0.05*sin(5*atan2(y-0.5,x-0.5)) - 0.01*log10(2+cosh(3*x)) - 0.01*exp(-y^2.5)
[shape.hole]
type = circle
center = 0.5 0.5
radius = 0.1
[sizing]
type = expression
expression = 1 + 4*((x-0.5)^4+(y-0.5)^2)^0.75 + 0.1*asin(y/2)*acos(x/2) + 0.1*sinh(x)*tan(y) + 0.1*log2(3+asinh(x))
"""
CASES = {"formula size": SIZE, "formula shape": REGION, "boolean": "boolean.ini", "coast": "coast.ini",
         "wavy ring": "expression.ini", "torus": "torus_hole.ini"}


@dataclasses.dataclass(frozen=True)
class Build:
    """A way to build the program."""
    what: str
    arguments: tuple  # of CMake
    levels: tuple = ("",)  # values of TRIME_SIMD, one row each
    environment: tuple = ()  # (name, value) of the runs


def optimised(level, *arguments):
    """A Release build with another level of optimisation."""
    return ("-DCMAKE_BUILD_TYPE=RelWithDebInfo", f"-DCMAKE_CXX_FLAGS_RELWITHDEBINFO={level} -DNDEBUG", *arguments)


MPICH = ("-DCMAKE_BUILD_TYPE=Release", "-DMPI_CXX_COMPILER=mpicxx.mpich", "-DMPIEXEC_EXECUTABLE=mpiexec.mpich",
         "-DHDF5_C_COMPILER_EXECUTABLE=h5pcc.mpich")
GCC, CLANG = "-DCMAKE_CXX_COMPILER=g++", "-DCMAKE_CXX_COMPILER=clang++"
BUILDS = {
    "gcc-O3": Build("g++ -O3, as users run it", ("-DCMAKE_BUILD_TYPE=Release", GCC), ("", "avx2", "portable")),
    "gcc-O2": Build("g++ -O2", optimised("-O2", GCC)),
    "gcc-O1": Build("g++ -O1", optimised("-O1", GCC)),
    "clang-O2": Build("clang++ -O2", optimised("-O2", CLANG), ("", "portable")),
    "native": Build("g++ -O3 -march=native", ("-DCMAKE_BUILD_TYPE=Release", GCC, "-DTRIME_NATIVE=ON")),
    "mpich": Build("g++ -O3, MPICH", (*MPICH, GCC)),
    "aarch64": Build("AArch64, g++ -O2, qemu", optimised("-O2")),
}
REFERENCE = "gcc-O3"


class Failure(Exception):
    """A build or a run did not work; the message says which and why."""


def run(command, environment=None, seconds=7200):
    """Output of a command; Failure if it does not end with 0."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                              env=os.environ | (environment or {}), timeout=seconds)
    except subprocess.TimeoutExpired as error:
        raise Failure(f"no end within {seconds} s: {' '.join(map(str, command))}") from error
    if done.returncode != 0:
        text = "\n".join((done.stdout + done.stderr).splitlines()[-30:])
        raise Failure(f"exit code {done.returncode}: {' '.join(map(str, command))}\n{text}")
    return done.stdout


def build_program(name, directory, jobs, more):
    """Configures, with `more` arguments of CMake, and builds; returns the program."""
    place = directory / name
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    parts = [f"-DTRIME_BUILD_{part}=OFF" for part in ("TESTS", "EXAMPLES", "BENCHMARKS", "CHECK")]
    arguments, environment = list(BUILDS[name].arguments), {}
    if name == "aarch64":
        foreign, environment = foreign_arguments(directory, ROOT)
        arguments += foreign
    print(f"Building {name} ...", file=sys.stderr, flush=True)
    run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", place, *launcher, *parts, *arguments, *more], environment)
    run(["cmake", "--build", place, f"-j{jobs}", "--target", "trime_mpi"])
    return place / "trime_mpi"


def hash_of_case(case, command, environment, directory):
    """mesh_hash of a config, by a program on one rank and one thread. Writes no mesh."""
    config = CASES[case]
    file = ROOT / "configs" / config
    if "\n" in config:
        file = directory / (case.replace(" ", "_") + ".ini")
        file.write_text(config, encoding="utf-8")
    report = directory / "report.json"
    report.unlink(missing_ok=True)
    run([*command, file, f"meshing.points={POINTS}", "output.interval=0", "--report", report],
        {"OMP_NUM_THREADS": "1"} | environment, seconds=1800)
    return json.loads(report.read_text(encoding="utf-8"))["attributes"]["mesh_hash_hex"]


def row_of(what, command, environment, cases, directory):
    """A row of the table: (what, [hash of each case])."""
    print(f"Running {what} ...", file=sys.stderr, flush=True)
    return what, [hash_of_case(case, command, environment, directory) for case in cases]


def rows_of_program(what, command, cases, directory):
    """The row of a program that exists, as a list."""
    return [row_of(what, shlex.split(command), {}, cases, directory)]


def rows_of(name, directory, jobs, more, cases):
    """The rows of a build."""
    build = BUILDS[name]
    program = build_program(name, directory, jobs, more)
    command, environment = [program], {}
    if name == "aarch64":
        command, environment = foreign_run(directory, program)
    return [row_of(build.what + (f", TRIME_SIMD={level}" if level else ""), command,
                   environment | ({"TRIME_SIMD": level} if level else {}), cases, directory) for level in build.levels]


def chosen(text, known, what):
    """The names in a list divided by commas; ends the program at an unknown one."""
    names = [name.strip() for name in text.split(",") if name.strip()]
    for name in names:
        if name not in known:
            sys.stderr.write(f"same_bits.py: unknown {what} '{name}'; known are {', '.join(known)}\n")
            sys.exit(2)
    return names


def compare(sources, cases):
    """Prints the table of all sources, pairs of a name and a function that makes its rows; the exit code."""
    print("| build | " + " | ".join(cases) + " | |\n|---|" + "---|" * (len(cases) + 1))
    first, code = None, 0
    for name, make_rows in sources:
        try:
            rows = make_rows()
        except (Failure, ForeignError, OSError) as error:
            print(f"| {name} |" + " |" * len(cases) + " FAILED |", flush=True)
            sys.stderr.write(f"same_bits.py: {name}: {error}\n")
            if first is None:
                return 4  # nothing to compare with
            code = 4
            continue
        for what, hashes in rows:
            first = first or hashes
            verdict = "same" if hashes == first else "DIFFERENT"
            print(f"| {what} | " + " | ".join(hashes) + f" | {verdict} |", flush=True)
            if hashes != first:
                code = code or 1
    return code


def sources_of(options, cases, directory):
    """What is compared: programs that exist, then builds."""
    sources = []
    for text in options.program:
        what, equals, command = text.partition("=")
        if not equals or not command:
            sys.stderr.write(f"same_bits.py: expected --program WHAT=COMMAND, found '{text}'\n")
            sys.exit(2)
        sources.append((what, functools.partial(rows_of_program, what, command, cases, directory)))
    builds = chosen(options.builds if options.builds or options.program else ",".join(BUILDS), BUILDS, "build")
    if builds and not options.program:
        builds = [REFERENCE] + [name for name in builds if name != REFERENCE]
    for name in builds:
        sources.append((name, functools.partial(rows_of, name, directory, options.jobs, options.cmake, cases)))
    return sources


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--builds", default="", metavar="LIST", help=f"default: all of {', '.join(BUILDS)}")
    parser.add_argument("--program", metavar="WHAT=COMMAND", action="append", default=[],
                        help="a program that exists already; may be repeated; without --builds nothing is built")
    parser.add_argument("--cases", default=",".join(CASES), metavar="LIST",
                        help=f"configs (default: all of {', '.join(CASES)})")
    parser.add_argument("--keep", metavar="DIR", type=pathlib.Path,
                        help="keep the builds in this directory for the next time")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at once (default: one per core)")
    parser.add_argument("--cmake", metavar="ARGUMENT", action="append", default=[],
                        help="for all builds, such as --cmake=-DTRIME_NATIVE=ON; may be repeated")
    options = parser.parse_args()
    cases = chosen(options.cases, CASES, "config")
    if not cases:
        parser.error("no configs are named")
    with tempfile.TemporaryDirectory(prefix="trime-same-bits-") as temporary:
        directory = (options.keep or pathlib.Path(temporary)).resolve()
        directory.mkdir(parents=True, exist_ok=True)
        sources = sources_of(options, cases, directory)
        print(f"{platform.machine()}, {POINTS} points asked for, one rank and thread:\n", flush=True)
        return compare(sources, cases)


if __name__ == "__main__":
    sys.exit(main())
