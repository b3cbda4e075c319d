#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the quality of meshes of contours from the mesh file and the contour alone, without knowledge of the mesher.

Usage: judge.py file MESH.h5 CONTOUR.xy [--json]            judges a mesh that exists
       judge.py run KIND SEED VERTICES POINTS SIZING [...]  meshes and judges one shape of real_shapes.py
       judge.py table SET [...] -o STEM                     judges a set (tuning, held_out); writes STEM.jsonl, STEM.md
       judge.py show FILE.jsonl ...                         prints the table of results that exist
       judge.py columns                                     explains the columns

SIZING is uniform, a gradation K of the automatic size (0.1), or a formula (=1+3*x). TRIME_PROGRAM names the program.
"""
import argparse
import configparser
import json
import pathlib
import re
import subprocess
import tempfile
import time

import h5py

import real_shapes
from mesh_measures import MeshMeasures
from ring_tools import even_odd_area, normalized, rings_of, text_of
from trime_run import PATIENCE, PROGRAM, environment

COLUMNS = {
    "shape": "kind, seed and vertices of real_shapes.py",
    "asked": "points asked for",
    "sizing": "uniform, K of the automatic size, or a formula",
    "exit": "exit code; `time` if the time ran out, then nothing else is known",
    "points": "points of the mesh",
    "triangles": "triangles of the mesh",
    "mean": "mean of alpha = R/2r over all triangles",
    "max": "largest alpha",
    "good": "share of triangles with alpha at most 1.2 [%]",
    "angle": "smallest angle [degrees]",
    "free_mean": "mean of alpha away from sharp corners (as `free`)",
    "free_good": "share of the triangles there with alpha at most 1.2 [%]",
    "forced": "triangles at sharp corners: those that `free` leaves out",
    "free": "largest alpha away from sharp corners: boundary vertices of the mesh with an inside angle below 56 "
            "degrees",
    "free_angle": "smallest angle there [degrees]",
    "kept": "the same where only corners count that are vertices of the input, bit for bit within 1e-9 of the "
            "container",
    "bad": "triangles with alpha above 1.5 away from sharp corners (as `free`)",
    "at": "place of the triangle of `free`",
    "deviation": "largest distance of a facet of the mesh from the input's curve, over the size that the boundary was "
                 "simplified for: the one asked for, times `coarse`",
    "deviation_at": "its place",
    "coarse": "the size that the boundary was simplified for, over that of the mesh",
    "lost": "largest distance of the input's curve from the mesh's boundary, over the local size: what was cut or "
            "dropped",
    "area": "area of the mesh over that of the shape, minus 1 [%]",
    "rings": "rings of the input",
    "loops": "closed loops of the mesh's boundary",
    "seconds": "wall time of the run",
    "cleanup": "share of the clean-up in the run [%]",
    "sweeps": "share of the sweeps and the set-up [%]",
    "warnings": "lines that say `warning:` under --quiet",
    "failed": "checks of the certificate that failed",
    "message": "first error",
}
SHOWN = ("shape", "asked", "sizing", "exit", "points", "triangles", "mean", "max", "good", "angle", "free",
         "free_angle", "free_mean", "free_good", "kept", "bad", "at", "deviation", "deviation_at", "coarse", "lost",
         "area", "rings", "loops", "seconds", "cleanup",
         "warnings")
# What issue 18 promises, column by column; a cell that breaks it is bold in the table.
GOALS = {"exit": lambda r: r["exit"] == 0,
         "free": lambda r: r["free"] <= 1.5,
         "free_angle": lambda r: r["free_angle"] >= 27,
         "good": lambda r: r["good"] >= 99.9,
         "mean": lambda r: r["mean"] <= (1.03 if r["asked"] >= r["vertices"] else 1.06),
         "deviation": lambda r: r["deviation"] <= 0.5,
         "cleanup": lambda r: r["cleanup"] <= 50}
CONTAINER = {"x_min": 0.0, "x_max": 1.0, "y_min": 0.0, "y_max": 1.0}


def input_rings(file, rings):
    """The rings where the mesh has them, by the config in the file."""
    ini = configparser.ConfigParser(inline_comment_prefixes=(";", "#"), strict=False, interpolation=None)
    ini.read_string(file["trime_mpi/config_resolved"][()].decode())
    contours = [name for name in ini.sections() if name.startswith("shape.") and ini[name].get("type") == "contour"]
    if len(contours) != 1:
        raise ValueError(f"one contour was expected in the config, found {len(contours)}")
    if ini[contours[0]].get("normalize", "false") != "true":
        return rings
    given = {name: ini.get("domain", name, fallback="auto") for name in CONTAINER}
    sides = {name: CONTAINER[name] if text == "auto" else float(text) for name, text in given.items()}
    return normalized(rings, (sides["x_min"], sides["y_min"]), (sides["x_max"], sides["y_max"]))


def judge_file(path, rings):
    """Columns that the mesh and the input alone give; places in the mesh's coordinates."""
    with h5py.File(path, "r") as file:
        places = input_rings(file, rings)
        measures = MeshMeasures(file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:],
                                file["VTKHDF/PointData/size"][:], places)
        coarseness = float(file["trime_mpi"].attrs.get("coarseness", 1))
        if "asked_size" in file["Mesh/facets"]:
            measures.set_asked_sizes(file["Mesh/facets/topology"][:], coarseness * file["Mesh/facets/asked_size"][:])
        timers = dict(zip(file["trime_mpi/timers/name"][:].astype(str), file["trime_mpi/timers/avg"][:]))
        checks = dict(zip(file["trime_mpi/checks/name"][:].astype(str), file["trime_mpi/checks/passed"][:]))
        whole = float(file["trime_mpi"].attrs["seconds_total"])
    area = even_odd_area(places)
    other = ("clean-up", "output", "extract", "certificate", "other")
    return {**measures.columns(), "coarse": coarseness, "area": 100 * (measures.area / area - 1), "shape_area": area,
            "rings": len(rings),
            "cleanup": 100 * timers.get("clean-up", 0.0) / whole,
            "sweeps": 100 * sum(t for name, t in timers.items() if name not in other) / whole,
            "failed": sorted(name for name, passed in checks.items() if not passed)}


def config_text(points, sizing):
    size = "type = uniform" if sizing == "uniform" else f"type = automatic\ngradation = {sizing}"
    if sizing.startswith("="):
        size = f"type = expression\nexpression = {sizing[1:]}"
    return (f"[shape]\ngeometry = it\n[shape.it]\ntype = contour\nfile = it.xy\nnormalize = true\n[sizing]\n{size}\n"
            f"[meshing]\npoints = {points}\n")


def run_and_judge(kind, seed, vertices, points, sizing, overrides=(), timeout=PATIENCE, keep=None):
    """All columns of one run; keep: a directory for config, contour, mesh and output."""
    row = {"shape": f"{kind} {seed} {vertices}", "vertices": vertices, "asked": points, "sizing": str(sizing)}
    rings = real_shapes.shape(kind, seed, vertices)
    with tempfile.TemporaryDirectory(prefix="trime-judge-") as temporary:
        name = re.sub(r"[^\w.=+-]", "_", f"{kind}-{seed}-{vertices}-{points}-{sizing}")
        work = pathlib.Path(keep) / name if keep else pathlib.Path(temporary)
        work.mkdir(parents=True, exist_ok=True)
        text = text_of(rings)
        (work / "it.xy").write_text(text, encoding="ascii")
        (work / "it.ini").write_text(config_text(points, sizing), encoding="ascii")
        command = ["nice", PROGRAM, work / "it.ini", f"output.directory={work}", "output.overwrite=true", "--quiet",
                   *overrides]
        (work / "it.h5").unlink(missing_ok=True)
        began = time.monotonic()
        try:
            done = subprocess.run(command, env=environment(1), capture_output=True, text=True, timeout=timeout,
                                  check=False)
        except subprocess.TimeoutExpired:
            return {**row, "exit": "time", "seconds": timeout}
        row.update(exit=done.returncode, seconds=time.monotonic() - began)
        said = done.stdout + done.stderr
        (work / "it.log").write_text(said, encoding="utf-8")
        row["warnings"] = len(re.findall(r"^warning:|: warning:", said, flags=re.MULTILINE))
        errors = [line for line in said.splitlines() if line and not line.startswith("warning:")]
        row["message"] = errors[0][:300] if done.returncode != 0 and errors else ""
        if (work / "it.h5").exists():
            row.update(judge_file(work / "it.h5", rings_of(text)))
    return row


def cell(row, name):
    """A column as text."""
    value = row.get(name, "")
    if name == "message" or value == "":
        return str(value)
    if name.endswith("at"):
        text = f"{value[0]:.4f} {value[1]:.4f}"
    elif name in ("mean", "good", "free_mean", "free_good"):
        text = f"{value:.4f}" if name.endswith("mean") else f"{value:.2f}"
    else:
        text = f"{value:.3g}" if isinstance(value, float) else str(value)
    try:
        broken = name in GOALS and not GOALS[name](row)
    except KeyError:
        broken = False
    return f"**{text}**" if broken else text


def by_shape(rows):
    """In the order of the sets, then of the numbers of points and the sizes."""
    order = [f"{kind} {seed} {vertices}" for shapes in real_shapes.SETS.values() for kind, seed, vertices in shapes]
    return sorted(rows, key=lambda row: (order.index(row["shape"]) if row["shape"] in order else len(order),
                                         row["shape"], row["asked"], row["sizing"] != "uniform", row["sizing"]))


def markdown(rows):
    """The table, and below it what the runs without a mesh said."""
    rows = by_shape(rows)
    lines = ["| " + " | ".join(SHOWN) + " |", "|" + "---|" * len(SHOWN)]
    lines += ["| " + " | ".join(cell(row, name) for name in SHOWN) + " |" for row in rows]
    known = [row for row in rows if "free" in row]
    kept = sum(all(goal(row) for goal in GOALS.values()) for row in known)
    lines += ["", f"{len(rows)} runs, {len(known)} meshes, {kept} of them as promised. In bold: what breaks a promise. "
              f"Goals kept: " + ", ".join(f"{name} {sum(GOALS[name](r) for r in known)}" for name in GOALS) + ".", ""]
    lines += [f"* {row['shape']}, {row['asked']} points, {row['sizing']}: exit {row['exit']}: {row['message']}"
              for row in rows if row.get("message")]
    return "\n".join(lines) + "\n"


def one_line(row):
    return "  ".join(f"{name}={cell(row, name)}" for name in SHOWN if name in row).replace("*", "")


def numbers_of_points(vertices):
    """A tenth of the vertices, as many, and 20 times as many up to 1e5; shapes of few vertices are asked for others."""
    if vertices < 200:
        return [100, 2000, 20000]
    return [max(100, vertices // 10), vertices, min(20 * vertices, 100000)]


def table(options):
    """Runs what is not yet in the file of results, and writes the table again after each run."""
    results = options.output.with_suffix(".jsonl")
    rows = [json.loads(line) for line in results.read_text().splitlines()] if results.exists() else []
    known = {(row["shape"], row["asked"], row["sizing"]) for row in rows}
    for kind, seed, vertices in real_shapes.SETS[options.set]:
        for points in numbers_of_points(vertices):
            for sizing in options.sizing:
                left_out = (options.only and kind not in options.only) or (options.most and points > options.most)
                if left_out or (f"{kind} {seed} {vertices}", points, sizing) in known:
                    continue
                row = run_and_judge(kind, seed, vertices, points, sizing, options.override, options.timeout,
                                    options.keep)
                rows.append(row)
                print(one_line(row), flush=True)
                with results.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")
                options.output.with_suffix(".md").write_text(markdown(rows), encoding="utf-8")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("file")
    one.add_argument("mesh", type=pathlib.Path)
    one.add_argument("contour", type=pathlib.Path)
    run = commands.add_parser("run")
    run.add_argument("kind", choices=real_shapes.KINDS)
    for name in ("seed", "vertices", "points"):
        run.add_argument(name, type=int)
    run.add_argument("sizing")
    many = commands.add_parser("table")
    many.add_argument("set", choices=real_shapes.SETS)
    many.add_argument("-o", "--output", type=pathlib.Path, required=True, help="STEM of .jsonl and .md")
    many.add_argument("--only", nargs="+", choices=real_shapes.KINDS, help="kinds")
    many.add_argument("--sizing", nargs="+", default=["uniform", "0.1", "0.3"])
    many.add_argument("--most", type=int, help="leave out runs of more points")
    for command in (run, many):
        command.add_argument("--timeout", type=float, default=120, help="seconds of a run (default %(default)s)")
        command.add_argument("--keep", type=pathlib.Path,
                             help="keep config, contour, mesh and output below this directory")
        command.add_argument("--override", nargs="+", default=[], help="section.key=value ...")
    shown = commands.add_parser("show")
    shown.add_argument("results", type=pathlib.Path, nargs="+")
    for command in (one, run):
        command.add_argument("--json", action="store_true", help="all columns as JSON")
    commands.add_parser("columns")
    return parser.parse_args()


def main():
    options = arguments()
    if options.command == "columns":
        print("\n".join(f"{name:13} {meaning}" for name, meaning in COLUMNS.items()))
    elif options.command == "table":
        table(options)
    elif options.command == "show":
        lines = [line for path in options.results for line in path.read_text().splitlines()]
        print(markdown([json.loads(line) for line in lines]), end="")
    else:
        if options.command == "file":
            row = {"shape": options.contour.stem, **judge_file(options.mesh, rings_of(options.contour.read_text()))}
        else:
            row = run_and_judge(options.kind, options.seed, options.vertices, options.points, options.sizing,
                                options.override, options.timeout, options.keep)
        print(json.dumps(row) if options.json else one_line(row))


if __name__ == "__main__":
    main()
