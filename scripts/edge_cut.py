#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the compactness of the ranks' parts of a mesh with METIS and Scotch (Debian: metis, scotch).

  scripts/edge_cut.py                                     # the table of scripts/README.md; takes some minutes
  scripts/edge_cut.py --points 1e5 --parts 4 --mesh MESH.h5 ...

All three divide the same graph: it has a node for each triangle, and an edge for each pair of triangles with a common
side. The edge cut is the number of edges between parts. "Uneven" is the size of the largest part over the mean, minus
1. Our parts follow from the file: its points lie along a space-filling curve, a part is a range of equally many points,
and a triangle belongs to its first vertex. In a run the borders lie between tiles of about 500 points, so its parts are
less even by that. Without METIS or Scotch their columns stay empty.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
GRADED, UNIFORM = "type = automatic\ngradation = 0.1", "type = uniform"
SHAPES = {"disc, uniform": ("circle.ini", UNIFORM), "spade, graded": ("spade.ini", GRADED),
          "coast, graded": ("coast.ini", GRADED)}  # config, its size; the coast keeps its own


def made_mesh(program, shape, points, folder):
    """The mesh file of one of the shapes."""
    config, size = SHAPES[shape]
    text = (ROOT / "configs" / config).read_text(encoding="utf-8").replace(GRADED, size)
    for contour in (ROOT / "configs").glob("*.xy"):
        shutil.copy(contour, folder)
    (folder / config).write_text(text, encoding="utf-8")
    subprocess.run([program, folder / config, f"meshing.points={points}", f"output.directory={folder}",
                    "output.name=mesh", "output.overwrite=true"], check=True, stdout=subprocess.DEVNULL,
                   env=os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
    return folder / "mesh.h5"


def read_mesh(path):
    """Number of points, triangles [M, 3]."""
    with h5py.File(path) as file:
        return len(file["Mesh/mesh/geometry"]), file["Mesh/mesh/topology"][:].astype(numpy.int64)


def shared_sides(points, triangles):
    """Pairs of triangles [E, 2] that share a side."""
    ends = numpy.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    keys = ends[:, 0] * points + ends[:, 1]
    order = numpy.argsort(keys, kind="stable")
    same = numpy.flatnonzero(keys[order][1:] == keys[order][:-1])
    return numpy.column_stack((order[same], order[same + 1])) // 3


def our_parts(points, triangles, parts):
    """The part of each triangle."""
    return triangles[:, 0] * parts // points


def neighbour_lists(count, pairs):
    """Neighbours of all nodes one after the other, and where those of each begin."""
    both = numpy.vstack((pairs, pairs[:, ::-1]))
    both = both[numpy.lexsort((both[:, 1], both[:, 0]))]
    return both[:, 1], numpy.searchsorted(both[:, 0], numpy.arange(count + 1))


def write_graphs(count, pairs, folder):
    """The graph as METIS (from 1) and Scotch (from 0, with degrees) read it."""
    neighbours, begin = neighbour_lists(count, pairs)
    from_0, from_1 = neighbours.tolist(), (neighbours + 1).tolist()
    begin = begin.tolist()
    with open(folder / "graph", "w", encoding="ascii") as metis, \
            open(folder / "graph.grf", "w", encoding="ascii") as scotch:
        metis.write(f"{count} {len(pairs)}\n")
        scotch.write(f"0\n{count} {2 * len(pairs)}\n0 000\n")
        for first, last in zip(begin, begin[1:]):
            metis.write(" ".join(map(str, from_1[first:last])) + "\n")
            scotch.write(" ".join(map(str, [last - first] + from_0[first:last])) + "\n")


def metis_parts(folder, parts):
    """By gpmetis as it is, or None."""
    if not shutil.which("gpmetis"):
        return None
    subprocess.run(["gpmetis", folder / "graph", str(parts)], check=True, stdout=subprocess.DEVNULL)
    return numpy.loadtxt(folder / f"graph.part.{parts}", dtype=int)


def scotch_parts(folder, parts):
    """By gpart as it is, or None."""
    if not shutil.which("scotch_gpart"):
        return None
    subprocess.run(["scotch_gpart", str(parts), folder / "graph.grf", folder / "map"], check=True,
                   stdout=subprocess.DEVNULL)
    rows = numpy.loadtxt(folder / "map", dtype=int, skiprows=1)
    found = numpy.empty(len(rows), dtype=int)
    found[rows[:, 0]] = rows[:, 1]
    return found


def judged(part, pairs, parts):
    """Edge cut and unevenness."""
    sizes = numpy.bincount(part, minlength=parts)
    return int(numpy.count_nonzero(part[pairs[:, 0]] != part[pairs[:, 1]])), sizes.max() / sizes.mean() - 1


def rows_of(name, path, part_numbers, folder):
    """Table rows of a mesh."""
    points, triangles = read_mesh(path)
    pairs = shared_sides(points, triangles)
    write_graphs(len(triangles), pairs, folder)
    for parts in part_numbers:
        found = [our_parts(points, triangles, parts), metis_parts(folder, parts), scotch_parts(folder, parts)]
        cells, cuts = [], []
        for part in found:
            cut, uneven = judged(part, pairs, parts) if part is not None else (None, None)
            cuts.append(cut)
            cells += ["", ""] if cut is None else [str(cut), f"{100 * uneven:.1f} %"]
        others = [cut for cut in cuts[1:] if cut]
        ratio = f"{cuts[0] / min(others):.2f}" if others else ""
        yield f"| {name} {len(triangles)} | {parts} | " + " | ".join(cells) + f" | {ratio} |"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--points", default="1e5,1e6", help="points of the meshes to make (default: %(default)s)")
    options.add_argument("--parts", default="4,16,64", help="numbers of parts (default: %(default)s)")
    options.add_argument("--mesh", type=pathlib.Path, nargs="+", help="use these mesh files instead")
    options.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "trime_mpi",
                         help="the program that makes them (default: build/release/trime_mpi)")
    given = options.parse_args()
    part_numbers = [int(parts) for parts in given.parts.split(",")]
    print("| mesh, triangles | parts | ours: cut | uneven | METIS: cut | uneven | Scotch: cut | uneven "
          "| ours over the best |")
    print("|---|---|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory(prefix="trime-edge-cut-") as work:
        folder = pathlib.Path(work)
        meshes = [(path.stem, path) for path in given.mesh] if given.mesh else [
            (shape, points) for points in given.points.split(",") for shape in SHAPES]
        for name, source in meshes:
            path = source if given.mesh else made_mesh(given.program, name, int(float(source)), folder)
            for row in rows_of(name, path, part_numbers, folder):
                print(row, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
