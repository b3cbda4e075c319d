#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a fuzz target: its corpus first, then new inputs for some seconds, always from the same seed.

Usage: run_target.py BUILD/tests/fuzz/NAME_fuzz [--seconds S] [--keep DIRECTORY] [--grow DIRECTORY]
  --seconds S   of new inputs (default: TRIME_FUZZ_SECONDS, else 10)
  --keep D      where an input that breaks the program is kept; it belongs into tests/fuzz/corpus/NAME once it is mended
  --grow D      keep what reaches new code there, and begin with it
  --slowest S   seconds of one input, from which it is a finding (default 20; by the clock, so more on a busy machine)
Exits with 1 if an input breaks the program, needs more memory than it should, or takes too long.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
LARGEST_INPUT = 4096  # bytes
MEBIBYTES, LARGEST_ARRAY = 2048, 512  # of the process, sanitizers included, and of one allocation
SLOWEST = 20  # seconds of one input; small ones take milliseconds
WITH_MPI = {"mesh_file", "checkpoint"}  # Open MPI keeps some memory to the end


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--seconds", type=int, default=int(os.environ.get("TRIME_FUZZ_SECONDS", "10")))
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("findings"))
    parser.add_argument("--grow", type=pathlib.Path)
    parser.add_argument("--slowest", type=int, default=SLOWEST)
    arguments = parser.parse_args()
    name = arguments.program.name.removesuffix("_fuzz")
    corpus, words = HERE / "corpus" / name, HERE / "words" / f"{name}.dict"
    arguments.keep.mkdir(parents=True, exist_ok=True)
    in_memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # no disk to wait for
    with tempfile.TemporaryDirectory(prefix="trime-fuzz-", dir=in_memory) as work:
        grown = arguments.grow or pathlib.Path(work) / "grown"
        grown.mkdir(parents=True, exist_ok=True)
        command = [arguments.program.resolve(), grown.resolve(), corpus, "-seed=1", f"-max_len={LARGEST_INPUT}",
                   f"-max_total_time={arguments.seconds}", f"-timeout={arguments.slowest}", f"-rss_limit_mb={MEBIBYTES}",
                   f"-malloc_limit_mb={LARGEST_ARRAY}", f"-artifact_prefix={arguments.keep.resolve()}/{name}-",
                   "-print_final_stats=1"]
        command += [f"-dict={words}"] if words.exists() else []
        environment = dict(os.environ, TMPDIR=work, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_ess_singleton_isolated="1")  # no daemon beside it
        environment["ASAN_OPTIONS"] = f"detect_leaks={int(name not in WITH_MPI)}:" + os.environ.get("ASAN_OPTIONS", "")
        done = subprocess.run([str(word) for word in command], cwd=work, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
        left = [path.name for path in pathlib.Path(work).iterdir() if path != grown and not path.is_dir()]
    lines = done.stdout.splitlines()
    if done.returncode != 0 or left:
        print("\n".join(lines[-80:]))
        print(f"files left outside of a directory of their own: {left}" if left else "")
        return 1
    print("\n".join(line for line in lines if "stat::" in line or line.startswith("Done")))
    return 0


if __name__ == "__main__":
    sys.exit(main())
