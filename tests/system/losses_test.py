#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests what a mesh leaves out of a shape. The program counts every loop that it drops, fills or merges in a warning,
lists it in the file, and predicts it with --dry-run.
"""
import re
import unittest

import h5py
import numpy

from real_shapes import shape
from ring_tools import rings_of, signed_area, text_of
from trime_run import Workspace, run

CONFIG = ("[shape]\ngeometry = sea\n[shape.sea]\ntype = contour\nfile = sea.xy\nnormalize = true\n"
          "[meshing]\npoints = 800\nworst_alpha = 1e300\n")
LOST = {"dropped": "dropped", "hole filled": "filled", "holes filled": "filled", "merged with others": "merged"}
KEPT = "no part of the shape is simplified"


def counts_of(text):
    """Returns the number of lost loops by state and the number of all loops, as the warning gives them. Without a
    warning they are zeros and None."""
    counts = dict.fromkeys(LOST.values(), 0)
    told = re.search(r"(\d+) of (\d+) loops? (?:is|are) lost \(([^)]*)\)", text)
    if told is None:
        return counts, None
    for item in told[3].split(", "):
        number, words = item.split(" ", 1)
        counts[LOST[words]] += int(number)
    assert sum(counts.values()) == int(told[1]), told[0]
    return counts, int(told[2])


def comb(fins, bottom):
    """A bar on the bottom with thin fins to y = 0.8, as far from each other as they are thick."""
    width = 0.4 / fins
    lines = ["0.1 0.1", "0.9 0.1"]
    for fin in range(fins):
        x = 0.9 - 2 * fin * width
        lines += [f"{x} 0.8", f"{x - width} 0.8", f"{x - width} {bottom}"]
        lines.append(f"{x - 2 * width if fin < fins - 1 else 0.1} {bottom}")
    return "\n".join(lines) + "\n"


class Losses(unittest.TestCase):
    def prepare(self, work, rings):
        (work / "sea.xy").write_text(rings if isinstance(rings, str) else text_of(rings), "ascii")
        (work / "sea.ini").write_text(CONFIG, "ascii")
        return work / "sea.ini"

    def table(self, rings, *overrides, ranks=1):
        """Columns of the table of rings, the text of the run, and the tags of the mesh."""
        with Workspace() as work:
            done = run(self.prepare(work, rings), *overrides, "--quiet", f"output.directory={work}", ranks=ranks)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(work / "sea.h5", "r") as file:
                columns = {name: column[:] for name, column in file["trime_mpi/rings"].items()}
                for name in ("state", "tags", "part_name"):
                    columns[name] = [text.decode() for text in columns[name]]
                columns["coarseness"] = file["trime_mpi"].attrs["coarseness"]
                columns["shares"] = [file["trime_mpi"].attrs[name] for name in ("lost_share", "added_share")]
                return columns, done.stdout + done.stderr, set(numpy.unique(file["Mesh/facets/values"][:]))

    def test_islands_that_nearly_touch_stay_apart(self):
        columns, says, _ = self.table(text_of(shape("near_touch", 77, 1500)), ranks=2)
        self.assertEqual(counts_of(says)[1], None, says)
        self.assertLessEqual(set(columns["state"]), {"kept", "simplified"})

    def test_every_lost_loop_is_in_warning_and_file(self):
        for kind in ("islands", "carpet", "near_touch"):
            with self.subTest(kind=kind):
                text = text_of(shape(kind, 77, 1500))
                # With connect = keep, all islands that nearly touch stay.
                columns, says, tags = self.table(text, *["meshing.connect=cut"] * (kind == "near_touch"), ranks=2)
                told, loops = counts_of(says)
                states = columns["state"]
                self.assertGreater(sum(told.values()), 0, says)
                self.assertEqual(loops, len(states))
                self.assertEqual({state: states.count(state) for state in told}, told)
                self.assertEqual(loops, len(rings_of(text)))
                starts = [0] + [k + 1 for k, line in enumerate(text.splitlines()) if not line.strip()]
                self.assertLessEqual(set(columns["line"]), {start + 1 for start in starts})
                self.assertEqual(len(set(columns["line"])), loops)
                self.assertEqual({int(tag) for one in columns["tags"] for tag in one.split()}, tags)
                self.check_rows(columns)
                scale = columns["area"].max() / max(abs(signed_area(ring)) for ring in rings_of(text))
                areas = sorted(scale * abs(signed_area(ring)) for ring in rings_of(text))
                numpy.testing.assert_allclose(sorted(columns["area"]), areas, rtol=1e-6, atol=1e-13)

    def check_rows(self, columns):
        for state, tag, length, remains, deviation in zip(columns["state"], columns["tag"], columns["length"],
                                                          columns["remaining_length"], columns["largest_deviation"]):
            self.assertEqual(tag == 0, remains == 0)
            self.assertLessEqual(remains, length)
            self.assertLessEqual(deviation, 0.5 * columns["coarseness"])  # as the certificate has it
            if state in ("dropped", "filled"):
                self.assertEqual(tag, 0)
            elif state == "kept":
                self.assertEqual((remains, deviation), (length, 0))

    def test_a_shape_that_loses_nothing_has_no_warning(self):
        square = "0 0\n1 0\n1 1\n0 1\n\n0.4 0.4\n0.6 0.4\n0.6 0.6\n0.4 0.6\n"
        columns, says, tags = self.table(square)
        self.assertEqual(says, "")
        self.assertEqual((columns["state"], set(columns["tag"])), (["kept"] * 2, tags))
        self.assertEqual(columns["shares"], [0, 0])
        self.assertEqual(list(columns["line"]), [1, 6])

    def test_a_mesh_of_what_is_left_lies_in_the_container(self):
        """Fins that are moved apart have no room in it; a hole that touches a side of it."""
        touching = "0 0\n1 0\n1 1\n0 1\n\n0.5 0\n0.7 0.3\n0.3 0.3\n"
        for name, rings, points in (("fins", comb(30, bottom=0.101), 60), ("touching", touching, 900)):
            with self.subTest(name=name), Workspace() as work:
                done = run(self.prepare(work, rings), f"output.directory={work}", f"meshing.points={points}",
                           "shape.sea.normalize=false")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                with h5py.File(work / "sea.h5", "r") as file:
                    positions = file["Mesh/mesh/geometry"][:]
                self.assertGreaterEqual(positions.min(), 0)
                self.assertLessEqual(positions.max(), 1)

    def test_a_lost_share_of_the_area_alone_is_a_warning(self):
        spit = "0 0\n1 0\n1 1\n0.55 1\n0.55 1.9\n0.545 1.9\n0.545 1\n0 1\n"
        columns, says, _ = self.table(spit, "meshing.points=300")
        self.assertRegex(says, r"warning: .* 0\.4\d* % of its area is lost, 0 % is added\. More points")
        self.assertEqual(columns["state"], ["simplified"])
        self.assertAlmostEqual(columns["remaining_length"][0] / columns["length"][0], 4 / 5.8, delta=0.02)
        columns, says, _ = self.table(spit, "meshing.points=300", "meshing.keep_features=true")
        self.assertNotIn("area is lost", says)
        self.assertEqual(columns["state"], ["kept"])

    def test_the_dry_run_foretells_losses_and_what_keeps_everything(self):
        def box(x, y, side):
            return f"{x} {y}\n{x + side} {y}\n{x + side} {y + side}\n{x} {y + side}\n\n"
        sea = box(0, 0, 1) + "".join(box(0.1 + 0.2 * k, 0.5, 0.01 * (1 + k)) for k in range(4))
        with Workspace() as work:
            config = self.prepare(work, sea)
            done = run(config, "--dry-run", "meshing.points=200")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            told = run(config, "--quiet", "output.interval=0", "meshing.points=200").stdout
            self.assertEqual(counts_of(done.stdout), counts_of(told))
            self.assertGreaterEqual(counts_of(told)[0]["filled"], 2)
            self.assertRegex(done.stdout, r"(?m)^\d+ points keep everything; that was tried$")
            keeps = re.search(r"^edge_length = (\S+) keeps everything; that was tried$", done.stdout, re.M)
            self.assertAlmostEqual(float(keeps[1]), 0.8 * 0.04 / 3, delta=0.0015)  # a perimeter of 3 h
            for share, says in ((0.8, True), (1.5, False)):
                edge_length = f"meshing.edge_length={share * float(keeps[1])}"
                done = run(config, "--dry-run", "meshing.points=", edge_length)
                self.assertEqual(KEPT in done.stdout, says, done.stdout)


if __name__ == "__main__":
    unittest.main()
