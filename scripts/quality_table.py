#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the quality of the three methods on the shapes for which figures of TriMe++ exist.

The script writes a config for each row, runs trime_mpi on one rank, and prints a table in Markdown. Its columns are
median, mean and largest alpha, the smallest angle, the conformity to the size (standard deviation of L / (s h)),
sweeps, full sweeps and seconds. A sweep over a coarse mesh counts as a fraction of a full sweep: its number of points
over the final number. The last columns are the figures of TriMe++ (commit 3929c19, the better of one and two threads)
for the same shape and number of points.

  scripts/quality_table.py                                  # the shapes that need no data
  scripts/quality_table.py --data DIR                       # with DIR/poker.xy and DIR/north_america.xy
  scripts/quality_table.py --rows slope --methods cvt,hybrid meshing.seed=2
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError:
    sys.exit("quality_table.py needs the Python module h5py. Debian: apt-get install python3-h5py, for "
             "/usr/bin/python3")

ROOT = pathlib.Path(__file__).resolve().parent.parent
SQUARE = ("[shape]\ngeometry = plate\n[shape.plate]\ntype = rectangle\nx_min = 0.1\nx_max = 0.9\n"
          "y_min = 0.1\ny_max = 0.9\n")
POKER = ("[shape]\ngeometry = difference(spade, hole)\n[shape.spade]\ntype = contour\nfile = {data}/poker.xy\n"
         "normalize = true\n[shape.hole]\ntype = circle\ncenter = 0.5 0.7\nradius = 0.1\n")
COAST = "[shape]\ngeometry = coast\n[shape.coast]\ntype = contour\nfile = {data}/north_america.xy\nnormalize = true\n"


def automatic(gradation):
    return f"[sizing]\ntype = automatic\ngradation = {gradation}\n"


# name: config, points
ROWS = {
    "square 1e4": (SQUARE, 10000),
    "square 1e5": (SQUARE, 100000),
    "slope 2e4": (SQUARE + "[sizing]\ntype = expression\nexpression = 1+3*x+3*y\n", 20000),
    "poker 1e4": (POKER + automatic(0.1), 10000),
    "poker 1e5": (POKER + automatic(0.1), 100000),
    "coast 2e4": (COAST + automatic(0.2), 20000),
}
# TriMe++: median, mean, largest alpha; retriangulations.
REFERENCE = {
    ("square 1e4", "distmesh"): (1.010, 1.020, 1.33, "65-87"),
    ("square 1e4", "cvt"): (1.017, 1.032, 1.41, "36-50"),
    ("square 1e4", "hybrid"): (1.016, 1.030, 1.33, "31-54"),
    ("square 1e5", "distmesh"): (1.010, 1.020, 1.537, "38-89"),
    ("square 1e5", "cvt"): (1.019, 1.034, 1.521, "36-40"),
    ("square 1e5", "hybrid"): (1.015, 1.029, 1.507, "35-51"),
    ("poker 1e4", "distmesh"): (1.017, 1.033, 14.8, "82-94"),
    ("poker 1e4", "cvt"): (1.024, 1.043, 7.66, "115-116"),
    ("poker 1e4", "hybrid"): (1.019, 1.035, 4.64, "93-110"),
    ("poker 1e5", "distmesh"): (1.017, 1.034, 16.5, "106-115"),
    ("poker 1e5", "cvt"): (1.021, 1.038, 31.1, "124-126"),
    ("poker 1e5", "hybrid"): (1.017, 1.033, 3.82, "107-115"),
    ("coast 2e4", "hybrid"): (1.035, 1.060, 6.24, "96-108"),
}


def run(program, directory, name, config, points, method, overrides):
    """Attributes of the mesh file that one run writes."""
    path = directory / (name.replace(" ", "_") + "_" + method + ".ini")
    path.write_text(f"{config}[meshing]\nmethod = {method}\npoints = {points}\n")
    command = [program, path, f"output.directory={directory}", "output.overwrite=true", "log.level=error", *overrides]
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{name}, {method}: exit code {done.returncode}\n{done.stderr}{done.stdout}")
    with h5py.File(path.with_suffix(".h5")) as file:
        group = file["trime_mpi"]
        found = dict(group.attrs)
        found.update({key: value for key, value in group["quality"].attrs.items()})
        stages = group["history/stage"][:]
        sweeps, points_of_sweep = group["history/sweep"][:], group["history/points"][:]
        found["final_sweeps"] = int(sweeps[-1] - sweeps[stages == stages.max()][0])
        swept = ((sweeps[1:] - sweeps[:-1]) * points_of_sweep[1:]).sum()
        found["all_points_sweeps"] = swept / max(1, int(found["points"]))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, help="the directory of poker.xy and north_america.xy")
    parser.add_argument("--program", default=ROOT / "build" / "release" / "trime_mpi",
                        help="the program to measure (default: build/release/trime_mpi)")
    parser.add_argument("--methods", default="distmesh,cvt,hybrid", help="default: %(default)s")
    parser.add_argument("--rows", default="", help="only the rows whose name contains this text")
    parser.add_argument("overrides", nargs="*", help="section.key=value, for every run")
    arguments = parser.parse_args()
    print("| shape, points | method | median | mean | max alpha | min angle | std of L/(s h) | sweeps | full sweeps "
          "| s | TriMe++ median | mean | max | retriangulations |")
    print("|" + "---|" * 14)
    with tempfile.TemporaryDirectory() as directory:
        for name, (config, points) in ROWS.items():
            if arguments.rows not in name or ("{data}" in config and not arguments.data):
                continue
            for method in arguments.methods.split(","):
                text = config.format(data=arguments.data.resolve()) if "{data}" in config else config
                q = run(arguments.program, pathlib.Path(directory), name, text, points, method, arguments.overrides)
                reference = REFERENCE.get((name, method), ("", "", "", ""))
                print(f"| {name} ({q['points']}) | {method} | {q['alpha_median']:.4f} | {q['alpha_mean']:.4f} "
                      f"| {q['alpha_max']:.3f} | {q['min_angle_degrees']:.1f} | {q['size_std']:.3f} "
                      f"| {q['iterations']} | {q['all_points_sweeps']:.0f} | {q['seconds_total']:.2f} | "
                      + " | ".join(str(value) for value in reference) + " |", flush=True)


if __name__ == "__main__":
    main()
