#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares meshes with regions and curves with those of Gmsh: points, quality and seconds.

The shapes come from seeds: a checkerboard, inclusions, grains, layers that pinch out, and a network of faults. Gmsh
fragments the polygons by OpenCASCADE and embeds the curves, with one size everywhere, and meshes by its
Frontal-Delaunay algorithm. The script changes this size until Gmsh makes about as many points as the program does. The
seconds are processor seconds on one thread: for Gmsh those of fragments and mesh without the search for the size, for
the program those of the whole run. The script prints a table in Markdown.

  scripts/region_rivals.py [--program FILE] [--cases NAMES] [--seed S] [--keep DIRECTORY]
"""
import argparse
import json
import math
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np
from scipy.spatial import Voronoi

ROOT = pathlib.Path(__file__).resolve().parent.parent
NEAR, TRIALS = 0.03, 5  # as many points, to this share of them, within so many runs of Gmsh
BAD = 2.0               # alpha of triangles that are counted: a least angle below about 22 degrees
PATIENCE = 900          # seconds for one run of Gmsh


def checkerboard(_):
    squares = [[(i / 8, j / 8), ((i + 1) / 8, j / 8), ((i + 1) / 8, (j + 1) / 8), (i / 8, (j + 1) / 8)]
               for i in range(8) for j in range(8)]
    return [("black" if (k // 8 + k % 8) % 2 else "white", ring) for k, ring in enumerate(squares)], []


def inclusions(rng, count=500, gap=0.004):
    """Round ones of different radii that keep a gap."""
    discs = []
    for _ in range(1000 * count):
        radius = rng.uniform(0.005, 0.02)
        x, y = rng.uniform(radius + gap, 1 - radius - gap), rng.uniform(radius + gap, 1 - radius - gap)
        if all(math.hypot(x - u, y - v) > radius + r + gap for u, v, r in discs):
            discs.append((x, y, radius))
        if len(discs) == count:
            break
    turns = [math.pi * k / 6 for k in range(12)]
    return [("fibre", [(x + r * math.cos(t), y + r * math.sin(t)) for t in turns]) for x, y, r in discs], []


def grains(rng, count=1000):
    """The Voronoi cells of random points, cut at the square by mirrored points."""
    own = np.array([(rng.random(), rng.random()) for _ in range(count)])
    mirrored = [own * [sx, sy] + [cx, cy] for sx, sy, cx, cy in
                ((1, 1, 0, 0), (-1, 1, 0, 0), (-1, 1, 2, 0), (1, -1, 0, 0), (1, -1, 0, 2))]
    cells = Voronoi(np.vstack(mirrored))
    places = np.round(np.clip(cells.vertices, 0, 1), 12).tolist()
    return [(f"g{k}", [tuple(places[v]) for v in cells.regions[cells.point_region[k]]]) for k in range(count)], []


def layers(rng, count=6):
    """Wavy layers. Every second one becomes thinner and ends."""
    steps = [k / 80 for k in range(81)]
    borders = [[0.0] * 81]
    for k in range(1, count):
        phase, bend = rng.uniform(0, 6), rng.uniform(0.02, 0.06)
        line = [k / count + bend * math.sin(2 * math.pi * x + phase) for x in steps]
        borders.append([max(low, y) for low, y in zip(borders[-1], line)])
        if k % 2 == 0:  # the layer below ends where its upper border meets the lower one
            end = rng.uniform(0.4, 0.8)
            borders[-1] = [low + (y - low) * max(0.0, 1 - x / end)
                           for x, low, y in zip(steps, borders[-2], borders[-1])]
    borders.append([1.0] * 81)
    rings = []
    for k, (low, high) in enumerate(zip(borders, borders[1:])):
        last = max(i for i in range(81) if high[i] - low[i] > 0)
        stop = min(last + 1, 80)
        ring = [(steps[i], low[i]) for i in range(stop + 1)] + [(steps[i], high[i]) for i in range(stop, -1, -1)]
        rings.append((f"layer{k}", [p for p, before in zip(ring, [ring[-1], *ring]) if p != before]))
    return rings, []


def faults(rng, count=200):
    lines = []
    for _ in range(count):
        x, y = rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)
        turn, half = rng.uniform(0, math.pi), rng.uniform(0.02, 0.08)
        lines.append([(x - half * math.cos(turn), y - half * math.sin(turn)),
                      (x + half * math.cos(turn), y + half * math.sin(turn))])
    return [], lines


CASES = {"checkerboard": (checkerboard, 5000), "inclusions": (inclusions, 40000), "grains": (grains, 60000),
         "layers": (layers, 10000), "faults": (faults, 40000)}


def feature(kind, coordinates, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


def write_map(path, features):
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}), encoding="ascii")


def config_of(rings, lines, points, directory):
    text = "[shape]\ngeometry = domain\n"
    if rings:
        write_map(directory / "r.geojson", [feature("Polygon", [[*ring, ring[0]]], unit=unit) for unit, ring in rings])
        text += f"[region.r]\nfile = {directory}/r.geojson\nattribute = unit\n"
    if lines:
        write_map(directory / "c.geojson", [feature("LineString", line) for line in lines])
        text += f"[curve.c]\nfile = {directory}/c.geojson\n"
    return text + f"[meshing]\npoints = {points}\n[output]\ndirectory = {directory}\nname = m\noverwrite = true\n"


def measures(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    sides = [np.hypot(*(u - v).T) for u, v in ((a, b), (b, c), (c, a))]
    twice_area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    alpha = sides[0] * sides[1] * sides[2] * sum(sides) / (4 * twice_area ** 2)
    return {"points": len(points), "mean": alpha.mean(), "worst": alpha.max(), "bad": int((alpha > BAD).sum())}


def our_run(program, text, directory):
    config = directory / "case.ini"
    config.write_text(text, encoding="utf-8")
    begun = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, config], capture_output=True, text=True, check=False,
                          env=os.environ | {"OMP_NUM_THREADS": "1"})
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = ended.ru_utime + ended.ru_stime - begun.ru_utime - begun.ru_stime
    if done.returncode != 0:
        sys.exit(f"region_rivals.py: {program} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    with h5py.File(directory / "m.h5") as file:
        return measures(file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]) | {"seconds": seconds}


def gmsh_mesh(rings, lines, size):
    """One run of Gmsh in this process."""
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 0)
    occ = gmsh.model.occ
    begun = time.process_time()
    square = (2, occ.addRectangle(0, 0, 0, 1, 1))
    tools = []
    for _, ring in rings:
        corners = [occ.addPoint(x, y, 0) for x, y in ring]
        sides = [occ.addLine(p, q) for p, q in zip(corners, corners[1:] + corners[:1])]
        tools.append((2, occ.addPlaneSurface([occ.addCurveLoop(sides)])))
    for line in lines:
        ends = [occ.addPoint(x, y, 0) for x, y in line]
        tools += [(1, occ.addLine(p, q)) for p, q in zip(ends, ends[1:])]
    occ.fragment([square], tools)  # lines become embedded in the surfaces that they cross
    occ.synchronize()
    for name in ("Mesh.MeshSizeMin", "Mesh.MeshSizeMax"):
        gmsh.option.setNumber(name, size)
    gmsh.option.setNumber("Mesh.Algorithm", 6)
    gmsh.model.mesh.generate(2)
    seconds = time.process_time() - begun
    tags, places, _ = gmsh.model.mesh.getNodes()
    row = np.zeros(int(tags.max()) + 1, int)
    row[tags.astype(int)] = np.arange(len(tags))
    _, corners = gmsh.model.mesh.getElementsByType(2)
    triangles = row[corners.astype(int).reshape(-1, 3)]
    points = places.reshape(-1, 3)[:, :2]
    gmsh.finalize()
    used = np.unique(triangles)
    return measures(points, triangles) | {"points": len(used), "seconds": seconds}


def gmsh_run(case, seed, points):
    """Runs in processes of their own, so that one that does not end can be stopped."""
    size = (1 / (0.8660254 * points)) ** 0.5
    made = None
    for _ in range(TRIALS):
        try:
            done = subprocess.run([sys.executable, __file__, "--gmsh-case", case, "--seed", str(seed),
                                   "--size", repr(size)], capture_output=True, text=True, check=False,
                                  timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            return made
        if done.returncode != 0:
            print(done.stderr[-500:], file=sys.stderr)
            return made
        made = json.loads(done.stdout.splitlines()[-1])
        if abs(made["points"] - points) < NEAR * points:
            break
        size *= (made["points"] / points) ** 0.5
    return made


def row(name, who, made):
    if made is None:
        print(f"| {name} | {who} | no mesh | | | | |", flush=True)
    else:
        print(f"| {name} | {who} | {made['points']} | {made['mean']:.4f} | {made['worst']:.2f} | {made['bad']} "
              f"| {made['seconds']:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "trime_mpi"))
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="write the configs and the meshes here")
    parser.add_argument("--gmsh-case", help=argparse.SUPPRESS)
    parser.add_argument("--size", type=float, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.gmsh_case:
        make, _ = CASES[arguments.gmsh_case]
        rings, lines = make(random.Random(arguments.seed))
        print(json.dumps({key: float(value) if key != "points" and key != "bad" else int(value)
                          for key, value in gmsh_mesh(rings, lines, arguments.size).items()}))
        return
    print(f"| shape | by | points | mean alpha | largest | above {BAD:.0f} | seconds |\n|---|---|---|---|---|---|---|")
    for name in arguments.cases.split(","):
        make, points = CASES[name]
        with tempfile.TemporaryDirectory() as scratch:
            directory = pathlib.Path(arguments.keep / name if arguments.keep else scratch)
            directory.mkdir(parents=True, exist_ok=True)
            rings, lines = make(random.Random(arguments.seed))
            ours = our_run(arguments.program, config_of(rings, lines, points, directory), directory)
        row(name, "TriMe-MPI", ours)
        row(name, "Gmsh", gmsh_run(name, arguments.seed, ours["points"]))


if __name__ == "__main__":
    main()
