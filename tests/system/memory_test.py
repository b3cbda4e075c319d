# SPDX-License-Identifier: BSD-3-Clause
"""The bytes per point at the peak of whole runs, output included. No times: the peak is the same on any machine, but for
huge pages (some 2 MiB an array) and what the libraries take."""
import re
import sys

import trime_run

# What a point may cost when it is added, from one run to a larger one: the fixed costs of the program cancel out.
FEW, MANY = 200000, 800000
CASES = (("uniform", ["[shape]", "region = domain"], 145),
         ("graded", ["[shape]", "region = domain", "[sizing]", "type = expression", "expression = 1+3*x+3*y"], 150))


def output_of(config, *more):
    """What a run prints that goes well."""
    run = trime_run.run(config, *more, threads=2, timeout=600)
    if run.returncode != 0:
        sys.exit(f"{config}: exit {run.returncode}\n{run.stderr}")
    return run.stdout


def measure(config, points):
    """Points made, and the bytes over all ranks by the report."""
    report = output_of(config, f"meshing.points={points}", f"output.directory={config.parent}", "output.overwrite=true")
    made = int(re.search(r"^(\d+) points", report, re.MULTILINE)[1])
    return made, made * float(re.search(r"([\d.]+) bytes per point over all ranks", report)[1])


def is_small(config, limit):
    """True if points cost no more than allowed, and no more than --dry-run foretells."""
    few, few_bytes = measure(config, FEW)
    many, many_bytes = measure(config, MANY)
    each = (many_bytes - few_bytes) / (many - few)
    dry_run = output_of(config, f"meshing.points={MANY}", "--dry-run")
    foretold = float(re.search(r"([\d.]+) MiB of memory", dry_run)[1]) * 2**20
    print(f"{config.stem}: {each:.1f} bytes a point (at most {limit}), {many_bytes / many:.1f} with all fixed costs; "
          f"{many_bytes / 2**20:.0f} MiB in all, {foretold / 2**20:.0f} MiB foretold")
    return each <= limit and many_bytes <= 1.1 * foretold


def main():
    """All cases; exit 1 if one needs more than it may."""
    with trime_run.Workspace() as workspace:
        small = True
        for name, text, limit in CASES:
            config = workspace / f"{name}.ini"
            config.write_text("\n".join(text + ["[meshing]", f"points = {FEW}"]) + "\n")
            small &= is_small(config, limit)
        if not small:
            sys.exit("more memory than allowed")


if __name__ == "__main__":
    main()
