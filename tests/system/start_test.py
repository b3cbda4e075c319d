#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests meshes that start from the points of an old mesh (`start` in [meshing]): a disc that moves through a channel,
other sizes, the same bits on any ranks, restarts, and old meshes that cannot be used."""
import itertools
import unittest

import h5py

from trime_run import WorkspaceCase, run

CHANNEL = """[domain]
x_max = 2
y_max = 1
[shape.disc]
type = circle
center = {x!r} 0.5
radius = 0.2
[shape]
geometry = difference(domain, disc)
[meshing]
{meshing}
"""
# Case 24: a disc of two materials.
CORE = """[domain]
x_max = 1
y_max = 1
[shape.disc]
type = circle
center = 0.5 0.5
radius = 0.4
[shape.inner]
type = circle
center = 0.5 0.5
radius = 0.2
[shape]
geometry = disc
[region.core]
geometry = inner
[region.rest]
geometry = difference(disc, inner)
[meshing]
points = {points}
"""
STEP = 0.03  # an edge
USAGE, STOPPED = 2, 75  # exit codes


class Start(WorkspaceCase):
    def mesh(self, name, x=0.5, meshing=f"edge_length = {STEP}", extra=(), ranks=1, text=None):
        """Makes a mesh of the channel, or of another config, and returns the finished run."""
        config = self.directory / f"{name}.ini"
        config.write_text(text or CHANNEL.format(x=x, meshing=meshing))
        return run(config, f"output.directory={self.directory}", f"output.name={name}", "output.overwrite=true", *extra,
                   ranks=ranks)

    def made(self, name, **options):
        """Makes a mesh, and returns what its file says about it."""
        done = self.mesh(name, **options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with h5py.File(self.directory / f"{name}.h5", "r") as file:
            group = file["trime_mpi"]
            return {"hash": group.attrs["mesh_hash"], "sweeps": int(group["history/sweep"][-1]),
                    "alpha": float(group["quality"].attrs["alpha_max"]), "points": len(file["Mesh/mesh/geometry"]),
                    "start": group.attrs.get("start_file", b""), "start_hash": group.attrs.get("start_hash", 0)}

    def test_a_disc_moves_through_a_channel(self):
        fresh = self.made("step0")
        for step in range(1, 6):
            made = self.made(f"step{step}", x=0.5 + step * STEP, extra=[f"meshing.start=step{step - 1}.h5"])
            self.assertLessEqual(made["sweeps"], max(9, fresh["sweeps"] // 2))
            self.assertLess(made["alpha"], max(1.25, fresh["alpha"] + 0.1))
            self.assertAlmostEqual(made["points"] / fresh["points"], 1, delta=0.03)
            self.assertTrue(str(made["start"]).endswith(f"step{step - 1}.h5'"), made["start"])
            self.assertNotEqual(made["start_hash"], 0)

    def test_other_sizes_and_numbers_have_the_same_bits_on_any_ranks(self):
        self.made("old")
        for name, meshing in (("many", "points = 8000"), ("few", "points = 900"), ("same", f"edge_length = {STEP}"),
                              ("graded", "points = 3000\n[sizing]\ntype = expression\nexpression = 1 + 4*x")):
            found = [self.made(f"{name}{ranks}", x=0.53, meshing=meshing, extra=["meshing.start=old.h5"], ranks=ranks)
                     for ranks in (1, 3)]
            self.assertEqual(found[0]["hash"], found[1]["hash"], name)
            self.assertEqual(found[0]["start_hash"], found[1]["start_hash"])
            if meshing.startswith("points"):
                wanted = int(meshing.split()[2])
                self.assertLessEqual(found[0]["points"], wanted)
                self.assertGreater(found[0]["points"], 0.98 * wanted, name)

    def test_same_config_takes_few_sweeps(self):
        for points in (1000, 2000):
            text = CORE.format(points=points)
            first = self.made("first", text=text)
            again = [self.made(f"again{ranks}", text=text, extra=["meshing.start=first.h5"], ranks=ranks)
                     for ranks in (1, 2, 3, 7)]
            self.assertEqual(len({made["hash"] for made in again}), 1)
            self.assertLessEqual(4 * again[0]["sweeps"], first["sweeps"])
            self.assertLessEqual(again[0]["alpha"], first["alpha"] + 0.02)
            self.assertLessEqual(again[0]["points"], points)
            self.assertGreater(again[0]["points"], 0.98 * points)

    def test_few_changes_leave_the_other_triangles_in_place(self):
        graded = "points = 6000\n[sizing]\ntype = expression\nexpression = min(3, 1 + 5*dist(disc))"
        self.made("old", meshing=graded)
        found = [self.made(f"new{ranks}", x=0.51, meshing=graded, extra=["meshing.start=old.h5"], ranks=ranks)
                 for ranks in (1, 2, 4)]
        self.assertEqual(len({made["hash"] for made in found}), 1)
        self.assertLess(found[0]["alpha"], 1.2)

    def test_restarts_after_each_sweep(self):
        self.made("old")
        whole = self.made("whole", x=0.56, extra=["meshing.start=old.h5"])
        stop = self.directory / "stop"
        for runs, ranks in enumerate(itertools.cycle((1, 2))):
            stop.touch()
            done = self.mesh("broken", x=0.56, ranks=ranks,
                             extra=["meshing.start=old.h5", f"checkpoint.stop_file={stop}", "--restart=auto"])
            if done.returncode != STOPPED:
                break
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreater(runs, 3)
        with h5py.File(self.directory / "broken.h5", "r") as file:
            self.assertEqual(file["trime_mpi"].attrs["mesh_hash"], whole["hash"])

    def test_old_meshes_that_cannot_be_used(self):
        self.made("old")
        torus = ["domain.periodic_x=true", "meshing.start=old.h5"]
        (self.directory / "text.h5").write_text("no mesh")
        for extra, expected in ((torus, r"old\.h5 has other periods .*expected .*x 2, y none.* found x none, y none"),
                                (["meshing.start=text.h5"], r"text\.h5.*expected a mesh file"),
                                (["meshing.start=missing.h5"], r"missing\.h5.*relative to the config"),
                                (["meshing.start=old.h5", "meshing.initial_fraction=0.2"], "keep one of them"),
                                (["meshing.start=old.h5", "domain.x_min=5", "domain.x_max=7",
                                  "shape.disc.center=6 0.5"], r"no point of .*old\.h5 can be a start: 0 of")):
            for ranks in (1, 3):
                done = self.mesh("new", extra=extra, ranks=ranks)
                self.assertEqual(done.returncode, USAGE, f"{extra}\n{done.stdout}{done.stderr}")
                self.assertRegex(" ".join(done.stderr.split()), expected)


if __name__ == "__main__":
    unittest.main()
