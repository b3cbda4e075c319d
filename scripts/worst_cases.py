#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds algorithms whose time grows quadratically: measures seconds and memory on difficult inputs of n, 2n and 4n
parts.

Usage: worst_cases.py PROGRAM [--only NAME ...] [--scale S] [--limit SECONDS] [--cpu]     PROGRAM: trime_mpi
The script prints a table. Each run has one rank, and as many threads as OMP_NUM_THREADS says (default: 1). The column
"exponent" is p where the time grows as n^p from the first to the last run: 1 for n or n log n, 2 for n^2.
"""
import argparse
import math
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile
import threading
import time

CASES = {}
MOST_MEMORY = 8 << 30  # bytes
MESH = "[meshing]\nmethod = cvd\npoints = {points}\n[output]\nname = mesh\nformats = {formats}\n"


def case(n, validate=True):
    """Registers a function that writes n of something to a directory and returns the config. @param validate the run
    ends before the mesh: what grows is the way to it"""
    def register(make):
        CASES[make.__name__] = (n, validate, make)
        return make
    return register


def tail(points=2000, formats="none"):
    return MESH.format(points=points, formats="vtkhdf" if formats == "none" else formats)


def write_rings(path, rings):
    path.write_text("\n".join("".join(f"{x:.17g} {y:.17g}\n" for x, y in ring) for ring in rings), encoding="utf-8")


def circle(n, x=0.5, y=0.5, radius=0.4):
    return [(x + radius * math.cos(2 * math.pi * k / n), y + radius * math.sin(2 * math.pi * k / n)) for k in range(n)]


def contour(directory, rings, more="", points=2000, formats="none"):
    write_rings(directory / "shape.xy", rings)
    return ("[shape]\ngeometry = s\n[shape.s]\ntype = contour\nfile = shape.xy\n" +
            tail(points, formats).replace("[output]", more + "[output]"))


@case(20000)
def fixed_vertices(directory, n):
    """Every vertex of a contour is a fixed point, too."""
    write_rings(directory / "points.xy", [circle(n)])
    return contour(directory, [circle(n)], "fixed_points = points.xy\n")


@case(50000)
def fixed_on_a_side(directory, n):
    """Fixed points on one vertical edge."""
    write_rings(directory / "points.xy", [[(0.1, 0.1 + 0.8 * (k + 0.5) / n) for k in range(n)]])
    return contour(directory, [[(0.1, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)]], "fixed_points = points.xy\n")


@case(50000)
def fixed_in_a_column(directory, n):
    """Fixed points inside, on one vertical line."""
    write_rings(directory / "points.xy", [[(0.5, 0.11 + 0.78 * (k + 0.5) / n) for k in range(n)]])
    return contour(directory, [[(0.1, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)]], "fixed_points = points.xy\n",
                   points=2000 + n)


def places_of_islands(n):
    side = math.ceil(math.sqrt(n))
    return [((k % side + 0.5) / side, (k // side + 0.5) / side, 0.3 / side) for k in range(n)]


def parts_config(bodies):
    names = ", ".join(f"p{k}" for k in range(len(bodies)))
    return (f"[domain]\nx_min = 0\nx_max = 1\ny_min = 0\ny_max = 1\n[shape]\n"
            f"geometry = difference(domain, union({names}))\n"
            + "".join(f"[shape.p{k}]\n{body}" for k, body in enumerate(bodies)))


@case(2500)
def rectangles_as_parts(directory, n):
    """Rectangles, each a separate part."""
    del directory
    return parts_config([f"type = rectangle\nx_min = {x - r}\nx_max = {x + r}\ny_min = {y - r}\ny_max = {y + r}\n"
                         for x, y, r in places_of_islands(n)]) + tail()


@case(2500)
def circles_as_parts(directory, n):
    """Circles, each a separate part."""
    del directory
    return parts_config([f"type = circle\ncenter = {x} {y}\nradius = {r}\n"
                         for x, y, r in places_of_islands(n)]) + tail()


@case(100000)
def misspelt_keys(directory, n):
    """Lines of keys that do not exist, which are errors: the program must report them soon."""
    del directory
    return "[shape]\ngeometry = domain\n[meshing]\n" + "".join(f"a{k} = 1\n" for k in range(n))


@case(100000)
def repeated_sections(directory, n):
    """The same section many times, which is an error: the program must report it soon."""
    del directory
    return "[shape]\ngeometry = domain\n" + "[meshing]\npoints = 5\n" * n


def comb(n, turn=math.pi / 4, x=0.5, y=0.5, length=0.8):
    """n long thin teeth, turned."""
    width = 0.5 * length / n
    corners = [(0.0, -0.05)]
    for k in range(n):
        corners += [(2 * k * width, 0.0), ((2 * k + 0.5) * width, length), ((2 * k + 1) * width, 0.0)]
    corners += [(2 * n * width, -0.05)]
    points = [(u - length / 2, v - length / 2) for u, v in corners]
    cos, sin = math.cos(turn), math.sin(turn)
    return [(x + cos * u - sin * v, y + sin * u + cos * v) for u, v in points]


@case(10000)
def slanted_comb(directory, n):
    """Long thin teeth side by side, turned by 45 degrees."""
    return contour(directory, [comb(n)])


@case(10000)
def star_of_spikes(directory, n):
    """Long thin spikes around a middle."""
    return contour(directory, [[(0.5 + r * math.cos(math.pi * k / n), 0.5 + r * math.sin(math.pi * k / n))
                                for k in range(2 * n) for r in [0.45 if k % 2 else 0.2]]])


@case(10000)
def comb_cut_by_lines(directory, n):
    """The comb as a part, united with another comb next to its teeth."""
    write_rings(directory / "a.xy", [comb(n)])
    write_rings(directory / "b.xy", [comb(n // 10, 1.25 * math.pi, 0.85, 0.15, 0.3)])
    return ("[shape]\ngeometry = union(a, b)\n[shape.a]\ntype = contour\nfile = a.xy\n"
            "[shape.b]\ntype = contour\nfile = b.xy\n" + tail())


@case(10000)
def circles_against_a_comb(directory, n):
    """The comb minus n circles among its teeth, each a separate part."""
    write_rings(directory / "a.xy", [comb(n)])
    turn, step = math.sqrt(0.5), 0.8 / n
    names = ", ".join(f"p{k}" for k in range(n))
    circles = []
    for k in range(n):
        u, v = (k + 0.3) * step - 0.4, 0.2 * (k % 3)
        circles.append(f"[shape.p{k}]\ntype = circle\ncenter = {0.5 + turn * (u - v)} {0.5 + turn * (u + v)}\n"
                       f"radius = {0.4 * step}\n")
    return (f"[shape]\ngeometry = difference(a, union({names}))\n[shape.a]\ntype = contour\nfile = a.xy\n" +
            "".join(circles) + tail())


@case(100000)
def crowded_vertices(directory, n):
    """Almost all vertices of a contour in a dent of 1e-8 of the container."""
    dent = [(0.5 + 1e-8 * math.cos(math.pi * k / n), 0.1 + 1e-8 * math.sin(math.pi * k / n)) for k in range(n + 1)]
    return contour(directory, [[(0.1, 0.1), *dent[::-1], (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)]])


@case(2500)
def rings_of_a_poly(directory, n):
    """A .poly file: a contour of 40 n vertices around n rings, each with its hole point."""
    around = circle(40 * n, radius=0.49)
    islands = [(0.5 + 0.6 * (x - 0.5), 0.5 + 0.6 * (y - 0.5), r / 2) for x, y, r in places_of_islands(n)]
    vertices, segments = [], []
    for ring in [around] + [[(x - r, y - r), (x + r, y - r), (x + r, y + r), (x - r, y + r)] for x, y, r in islands]:
        first = len(vertices)
        vertices += ring
        segments += [(first + k, first + (k + 1) % len(ring)) for k in range(len(ring))]
    text = [f"{len(vertices)} 2 0 0\n"] + [f"{k + 1} {x:.17g} {y:.17g}\n" for k, (x, y) in enumerate(vertices)]
    text += [f"{len(segments)} 0\n"] + [f"{k + 1} {a + 1} {b + 1}\n" for k, (a, b) in enumerate(segments)]
    text += [f"{n}\n"] + [f"{k + 1} {x:.17g} {y:.17g}\n" for k, (x, y, _) in enumerate(islands)]
    (directory / "shape.poly").write_text("".join(text), encoding="utf-8")
    return "[shape]\ngeometry = s\n[shape.s]\ntype = contour\nfile = shape.poly\n" + tail()


@case(2500, validate=False)
def text_of_islands(directory, n):
    """Text files of a mesh with n islands."""
    islands = [circle(8, 0.5 + 0.6 * (x - 0.5), 0.5 + 0.6 * (y - 0.5), r) for x, y, r in places_of_islands(n)]
    return contour(directory, [circle(100, radius=0.49)] + islands, points=100000, formats="text")


@case(250, validate=False)
def fins_that_are_cut(directory, n):
    """A comb of n fins far thinner than the triangles."""
    width = 0.4 / n
    ring = [(0.1, 0.1), (0.9, 0.1)]
    for k in range(n):
        x = 0.9 - 2 * k * width
        ring += [(x, 0.8), (x - width, 0.8), (x - width, 0.3), (x - 2 * width if k < n - 1 else 0.1, 0.3)]
    return contour(directory, [ring], points=500)


@case(1250, validate=False)
def spikes_that_are_smoothed(directory, n):
    """A star of n spikes far thinner than the triangles."""
    turns = [math.pi * k / n for k in range(2 * n)]
    radii = [0.1 if k % 2 == 0 else 0.4 for k in range(2 * n)]
    return contour(directory, [[(0.5 + r * math.cos(t), 0.5 + r * math.sin(t)) for r, t in zip(radii, turns)]],
                   points=500)


def koch(depth, every):
    """Each of `every` edges is divided once more than the others."""
    points = [(0.1, 0.3), (0.5, 0.3 + 0.8 * math.sqrt(0.75)), (0.9, 0.3)]
    turn = (math.cos(math.pi / 3), math.sin(math.pi / 3))
    for level in range(depth + 1):
        finer = []
        for k, ((x0, y0), (x1, y1)) in enumerate(zip(points, points[1:] + points[:1])):
            if level == depth and (every == 0 or k % every != 0):
                finer.append((x0, y0))
                continue
            dx, dy = (x1 - x0) / 3, (y1 - y0) / 3
            finer += [(x0, y0), (x0 + dx, y0 + dy),
                      (x0 + dx + turn[0] * dx - turn[1] * dy, y0 + dy + turn[1] * dx + turn[0] * dy),
                      (x0 + 2 * dx, y0 + 2 * dy)]
        points = finer
    return points


@case(49152, validate=False)
def koch_curve(directory, n):
    """A Koch curve of n vertices (3 times a power of 4, or twice that), and as many points."""
    depth = math.floor(math.log(n / 3, 4) + 0.01)
    return contour(directory, [koch(depth, 3 if n / (3 * 4 ** depth) > 1.5 else 0)], points=n)


@case(62500, validate=False)
def fractal_coast(directory, n):
    """A random coast of n vertices, and as many points."""
    source = random.Random(1)
    radii, spread = [0.3] * 4, 0.12
    while len(radii) < n:
        radii = [r for a, b in zip(radii, radii[1:] + radii[:1])
                 for r in (a, (a + b) / 2 + source.uniform(-spread, spread))]
        spread *= 0.55
    count = len(radii)
    return contour(directory,
                   [[(0.5 + r * math.cos(2 * math.pi * k / count), 0.5 + r * math.sin(2 * math.pi * k / count))
                     for k, r in enumerate(radii)]], points=n)


@case(250000, validate=False)
def sizes_over_six_decades(directory, n):
    """A size that grows from 1e-6 in the middle."""
    del directory
    return ("[shape]\ngeometry = domain\n[sizing]\ntype = expression\n"
            "expression = max(1e-6, sqrt((x-0.5)^2+(y-0.5)^2))\n" + tail(n))


@case(250000, validate=False)
def graded_torus(directory, n):
    """A torus with a size that varies."""
    del directory
    return ("[domain]\nx_min = 0\nx_max = 1\ny_min = 0\ny_max = 1\nperiodic_x = true\nperiodic_y = true\n[shape]\n"
            "geometry = domain\n[sizing]\ntype = expression\nexpression = 1+0.8*sin(2*pi*x)*sin(2*pi*y)\n" + tail(n))


def limit_memory():
    """No case may take the whole machine."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


def measured(program, config, validate, limit, cpu):
    """Seconds, peak memory in MB and exit code; seconds of the clock above the limit: ended there."""
    line = [program, str(config)] + (["--validate"] if validate else [f"output.directory={config.parent}"])
    environment = dict(os.environ, OMP_NUM_THREADS=os.environ.get("OMP_NUM_THREADS", "1"))
    begin = time.monotonic()
    with open(config.parent / "said", "w", encoding="utf-8") as said, \
            subprocess.Popen(line, env=environment, stdout=said, stderr=said, preexec_fn=limit_memory) as run:
        end = threading.Timer(limit, run.kill)
        end.start()
        _, status, usage = os.wait4(run.pid, 0)
        end.cancel()
        run.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.monotonic() - begin
    if cpu and seconds < limit:
        seconds = usage.ru_utime + usage.ru_stime
    return seconds, usage.ru_maxrss / 1024, run.returncode


def row(program, name, scale, limit, cpu):
    n, validate, make = CASES[name]
    n = max(round(n * scale), 1)
    times, peaks, remark = [], [], ""
    for count in (n, 2 * n, 4 * n):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "case.ini"
            config.write_text(make(config.parent, count), encoding="utf-8")
            seconds, peak, code = measured(program, config, validate, limit, cpu)
            said = (config.parent / "said").read_text(encoding="utf-8", errors="replace").strip().splitlines()
        times.append(seconds)
        peaks.append(peak)
        if seconds >= limit:
            remark = f"ended at {limit:g} s"
            break
        if code != 0:
            remark = f"exit {code}: {said[-1][:100] if said else ''}"
    steps = len(times) - 1
    exponent = f"{math.log2(times[-1] / times[0]) / steps:.1f}" if steps > 0 else ""
    cells = [f"{seconds:.2f}" for seconds in times] + [""] * (3 - len(times))
    return f"| {name} | {n} | {' | '.join(cells)} | {max(peaks):.0f} | {exponent} | {remark} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="trime_mpi")
    parser.add_argument("--only", nargs="+", choices=sorted(CASES), default=list(CASES), metavar="NAME",
                        help="only these cases of " + ", ".join(CASES))
    parser.add_argument("--scale", type=float, default=1, help="factor on all numbers of parts (default: 1)")
    parser.add_argument("--limit", type=float, default=600,
                        help="seconds after which a run is stopped (default: %(default)g)")
    parser.add_argument("--cpu", action="store_true",
                        help="measure processor seconds, on a machine that others use, too")
    options = parser.parse_args()
    print("| case | n | s at n | s at 2n | s at 4n | MB | exponent | |\n|---|---|---|---|---|---|---|---|", flush=True)
    for name in options.only:
        print(row(options.program, name, options.scale, options.limit, options.cpu), flush=True)


if __name__ == "__main__":
    sys.exit(main())
