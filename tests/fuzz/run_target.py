#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a fuzz target on its corpus, and then on new inputs for some seconds. The seeds are always the same.

Usage: run_target.py BUILD/tests/fuzz/NAME_fuzz [--seconds S] [--keep DIRECTORY] [--grow DIRECTORY]
  --seconds S   seconds of new inputs (default: TRIME_FUZZ_SECONDS, or 10)
  --keep D      keep an input that breaks the program here; move it to tests/fuzz/corpus/NAME after the repair
  --grow D      begin with the inputs of this directory, and keep those that reach new code there
  --slowest S   an input that takes longer than S seconds is a finding (default: 20; more on a busy machine)
The script exits with 1 if an input breaks the program, needs too much memory, or takes too long.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
LARGEST_INPUT = 4096  # bytes
MEBIBYTES, LARGEST_ARRAY = 2048, 512  # of the process, sanitizers included, and of one allocation
SLOWEST = 20  # seconds of one input; small ones take milliseconds
WITH_MPI = {"mesh_file", "checkpoint"}  # Open MPI keeps some memory to the end
# Of one process: HDF5 keeps a file whose chunks it could not read, with its communicator, and Open MPI has 2^16 of
# these.
MOST_RUNS = 20000


class Target:
    """A fuzz target with its corpus and its limits."""

    def __init__(self, arguments, work):
        self.program, self.slowest, self.work = arguments.program.resolve(), arguments.slowest, work
        self.name = arguments.program.name.removesuffix("_fuzz")
        self.kept = arguments.keep.resolve()
        self.grown = (arguments.grow or work / "grown").resolve()
        for directory in (self.kept, self.grown):
            directory.mkdir(parents=True, exist_ok=True)

    def command(self, seed, seconds):
        words = HERE / "words" / f"{self.name}.dict"
        command = [self.program, self.grown, HERE / "corpus" / self.name, f"-seed={seed}", f"-max_len={LARGEST_INPUT}",
                   f"-max_total_time={seconds}", f"-timeout={self.slowest}", f"-rss_limit_mb={MEBIBYTES}",
                   f"-malloc_limit_mb={LARGEST_ARRAY}", f"-artifact_prefix={self.kept}/{self.name}-",
                   "-print_final_stats=1"]
        command += [f"-runs={MOST_RUNS}"] if self.name in WITH_MPI else []
        return [str(word) for word in command + ([f"-dict={words}"] if words.exists() else [])]

    def environment(self):
        sanitizer = f"detect_leaks={int(self.name not in WITH_MPI)}:" + os.environ.get("ASAN_OPTIONS", "")
        return dict(os.environ, TMPDIR=str(self.work), OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", ASAN_OPTIONS=sanitizer,
                    OMPI_MCA_ess_singleton_isolated="1")  # starts no daemon

    def run(self, seed, seconds):
        """One process; true if it found nothing."""
        done = subprocess.run(self.command(seed, seconds), cwd=self.work, env=self.environment(),
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                              check=False)
        left = [path.name for path in self.work.iterdir() if path != self.grown and not path.is_dir()]
        lines = done.stdout.splitlines()
        if done.returncode != 0 or left:
            print("\n".join(lines[-80:]))
            print(f"files left outside of a directory of their own: {left}" if left else "")
            return False
        print("\n".join(line for line in lines if "stat::" in line or line.startswith("Done")), flush=True)
        return True


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--seconds", type=int, default=int(os.environ.get("TRIME_FUZZ_SECONDS", "10")))
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("findings"))
    parser.add_argument("--grow", type=pathlib.Path)
    parser.add_argument("--slowest", type=int, default=SLOWEST)
    arguments = parser.parse_args()
    in_memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # no disk to wait for
    end = time.monotonic() + arguments.seconds
    with tempfile.TemporaryDirectory(prefix="trime-fuzz-", dir=in_memory) as work:
        target = Target(arguments, pathlib.Path(work))
        seed = 1
        while target.run(seed, max(1, round(end - time.monotonic()))):
            seed += 1
            if end - time.monotonic() < 1:
                return 0
    return 1


if __name__ == "__main__":
    sys.exit(main())
