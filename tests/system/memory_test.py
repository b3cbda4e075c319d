# SPDX-License-Identifier: BSD-3-Clause
"""Tests the bytes per point at the peak of whole runs with their output.

The test measures no times. The peak is the same on any machine, except for huge pages (about 2 MiB per array) and the
memory of the libraries.
"""
import re
import sys

import trime_run
from dense_coast import dense_coast, text_of_coast

# What a point may cost when it is added, from one run to a larger one: the fixed costs of the program cancel out.
FEW, MANY = 200000, 800000
SEGMENTS = 2**17  # of a contour
CASES = (("uniform", ["[shape]", "geometry = domain"], 145),
         ("graded", ["[shape]", "geometry = domain", "[sizing]", "type = expression", "expression = 1+3*x+3*y"], 150))


def output_of(config, *more):
    """What a run prints that goes well."""
    run = trime_run.run(config, *more, threads=2, timeout=600)
    if run.returncode != 0:
        sys.exit(f"{config}: exit {run.returncode}\n{run.stderr}")
    return run.stdout


def measure(config, points):
    """Points made, and the bytes over all ranks by the report."""
    report = output_of(config, f"meshing.points={points}", f"output.directory={config.parent}", "output.overwrite=true",
                       "--verbose")
    made = int(re.search(r"^(\d+) points", report, re.MULTILINE)[1])
    return made, made * float(re.search(r"([\d.]+) bytes per point over all ranks", report)[1])


def is_small(config, limit):
    """True if a point costs no more than allowed, and no more than --dry-run predicts."""
    few, few_bytes = measure(config, FEW)
    many, many_bytes = measure(config, MANY)
    each = (many_bytes - few_bytes) / (many - few)
    dry_run = output_of(config, f"meshing.points={MANY}", "--dry-run")
    foretold = float(re.search(r"([\d.]+) MiB of memory", dry_run)[1]) * 2**20
    print(f"{config.stem}: {each:.1f} bytes a point (at most {limit}), {many_bytes / many:.1f} with all fixed costs; "
          f"{many_bytes / 2**20:.0f} MiB in all, {foretold / 2**20:.0f} MiB foretold")
    return each <= limit and many_bytes <= 1.1 * foretold


def is_foretold(directory):
    """True if --dry-run knows what a contour takes that has many more vertices than the mesh has points."""
    (directory / "coast.xy").write_text(text_of_coast(dense_coast(1, 0.12, SEGMENTS)), "ascii")
    config = directory / "coast.ini"
    config.write_text("[shape]\ngeometry = land\n[shape.land]\ntype = contour\nfile = coast.xy\nnormalize = true\n"
                      "[sizing]\ntype = automatic\n[meshing]\npoints = 5000\n", "ascii")
    foretold = float(re.search(r"over all ranks, at most ([\d.]+) per rank", output_of(config, "--dry-run"))[1])
    report = output_of(config, f"output.directory={directory}")
    taken = float(re.search(r"at most ([\d.]+) MiB per rank", report)[1])
    print(f"contour of {SEGMENTS} segments: {taken:.0f} MiB, {foretold:.0f} MiB foretold")
    return 0.5 * foretold < taken < 1.1 * foretold


def main():
    """All cases; exit 1 if one needs more than it may."""
    with trime_run.Workspace() as workspace:
        small = True
        for name, text, limit in CASES:
            config = workspace / f"{name}.ini"
            config.write_text("\n".join(text + ["[meshing]", f"points = {FEW}"]) + "\n")
            small &= is_small(config, limit)
        small &= is_foretold(workspace)
        if not small:
            sys.exit("more memory than allowed, or than foretold")


if __name__ == "__main__":
    main()
