#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the meshes of the steps of a run, and TriMe++'s text files: they are complete, the same on any number of ranks,
and equal to the HDF5 file.
"""
import json
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np

from trime_run import ROOT, Workspace, run

CONFIG = ROOT / "configs" / "boolean.ini"
POINTS = 800
EVERY = 5


class OutputSeries(unittest.TestCase):
    def run_config(self, directory, *arguments, ranks=1, threads=1):
        done = run(CONFIG, f"meshing.points={POINTS}", f"output.directory={directory}", "output.name=m", *arguments,
                   ranks=ranks, threads=threads)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def text_files(self, directory, ranks):
        """Content of all text files of a run."""
        self.run_config(directory, "output.formats=text", ranks=ranks)
        return {path.name: path.read_text(encoding="ascii") for path in (directory / "m").iterdir()}

    # TriMe++'s files

    def test_text_files_have_the_same_bytes_on_any_ranks(self):
        with Workspace() as one, Workspace() as three:
            self.assertEqual(self.text_files(one, 1), self.text_files(three, 3))
            self.assertEqual(sorted(path.name for path in one.iterdir()), ["m", "m.h5"])

    def test_text_files_tell_the_mesh(self):
        with Workspace() as work:
            texts = self.text_files(work, 2)
            with h5py.File(work / "m.h5") as file:
                xy, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
                facets, tags = file["Mesh/facets/topology"][:], file["Mesh/facets/values"][:]
                alpha, fixed = file["Mesh/CellData/alpha"][:], file["Mesh/PointData/fixed"][:]
                about = dict(file["trime_mpi"].attrs)
                quality = dict(file["trime_mpi/quality"].attrs)

        def table(ending):
            return np.array([[float(word) for word in line.split()]
                             for line in texts[f"m_final_{ending}.txt"].splitlines() if line])

        np.testing.assert_array_equal(table("xy_id"), xy)  # 17 digits: bit for bit
        rows = np.arange(len(triangles))
        np.testing.assert_array_equal(table("tria_vertex_ids"), np.column_stack([rows, triangles]))
        np.testing.assert_array_equal(table("tria_vertex_coords"),
                                      np.column_stack([rows, xy[triangles].reshape(len(rows), 6)]))
        np.testing.assert_allclose(table("tria_quality_stat_ar")[:, 0], alpha, rtol=1e-6)
        edges = table("tria_bar_ids").astype(int)
        expected = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        np.testing.assert_array_equal(np.unique(edges, axis=0), expected)
        self.assertEqual(len(edges), len(expected), "each edge once")
        np.testing.assert_array_equal(table("tria_bar_coords").reshape(-1, 4), xy[edges].reshape(-1, 4))
        np.testing.assert_array_equal(np.array(texts["fixed_pt_id.txt"].split(), dtype=int), np.flatnonzero(fixed))
        overall = [float(word) for word in texts["m_tria_quality_stat_overall.txt"].split()]
        self.assertEqual(len(overall), 13)
        self.assertEqual(overall[:3], [about["retriangulation"], len(xy), len(triangles)])
        self.assertEqual(overall[3:7], [quality[name] for name in ("alpha_max", "beta_max", "alpha_median",
                                                                   "beta_median")])
        self.check_loops(texts, xy, facets, tags)

    def check_loops(self, texts, xy, facets, tags):
        """Loops are counter-clockwise and hold every boundary edge once."""
        loops = sorted(name for name in texts if "_bdry_vertices_ids_CCW_" in name)
        self.assertEqual(len(loops), len(np.unique(tags)))
        seen = []
        for name in loops:
            ids = np.array(texts[name].split(), dtype=int)
            places = np.array(texts[name.replace("_ids_", "_coords_")].split(), dtype=float).reshape(-1, 2)
            np.testing.assert_array_equal(places, xy[ids])
            x, y = places.T
            self.assertGreater(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)), 0, "counter-clockwise")
            seen += [tuple(sorted(edge)) for edge in zip(ids.tolist(), np.roll(ids, -1).tolist())]
        self.assertEqual(sorted(seen), sorted(tuple(sorted(edge)) for edge in facets.tolist()))

    # Steps

    def steps(self, directory):
        return sorted(int(path.stem.split("_")[-1]) for path in directory.glob("m_step_*.h5"))

    def test_first_and_final_mesh(self):
        with Workspace() as work, Workspace() as plain:
            self.run_config(work, "output.interval=-2")
            self.run_config(plain, "output.formats=vtkhdf xdmf")
            self.assertEqual(self.steps(work), [1])
            self.check_collections(work)
            with h5py.File(work / "m.h5") as a, h5py.File(plain / "m.h5") as b, \
                    h5py.File(work / "m_step_000001.h5") as first:
                self.assertEqual(a["trime_mpi"].attrs["mesh_hash"], b["trime_mpi"].attrs["mesh_hash"])
                self.assertNotEqual(a["trime_mpi"].attrs["mesh_hash"], first["trime_mpi"].attrs["mesh_hash"])
                self.assertEqual(int(first["trime_mpi"].attrs["complete"]), 0, "no step passes for a finished mesh")
                self.assertEqual(int(a["trime_mpi"].attrs["complete"]), 1)

    def test_every_nth_mesh_is_the_same_on_any_ranks(self):
        with Workspace() as one, Workspace() as two:
            arguments = [f"output.interval={EVERY}", "output.formats=vtkhdf xdmf text"]
            self.run_config(one, *arguments)
            self.run_config(two, *arguments, ranks=2, threads=2)
            steps = self.steps(one)
            self.assertEqual(steps, [1] + list(range(EVERY, steps[-1] + 1, EVERY)))
            self.assertGreater(len(steps), 2)
            self.check_collections(one)
            for path in sorted(one.glob("m*.h5")):
                with h5py.File(path) as a, h5py.File(two / path.name) as b:
                    self.assertEqual(a["trime_mpi"].attrs["mesh_hash"], b["trime_mpi"].attrs["mesh_hash"], path.name)
            for path in sorted((one / "m").iterdir()):
                self.assertEqual(path.read_text(), (two / "m" / path.name).read_text(), path.name)
            lines = (one / "m" / "m_tria_quality_stat_overall.txt").read_text().splitlines()
            self.assertEqual([int(line.split()[0]) for line in lines[:-1]], steps)

    def check_collections(self, directory):
        """Both name every mesh, in order, and what they say of it is true."""
        series = json.loads((directory / "m.vtkhdf.series").read_text())
        self.assertEqual(series["file-series-version"], "1.0")
        names = [entry["name"] for entry in series["files"]]
        times = [entry["time"] for entry in series["files"]]
        self.assertEqual(names, [f"m_step_{step:06d}.vtkhdf" for step in self.steps(directory)] + ["m.vtkhdf"])
        self.assertEqual(times, sorted(set(times)))
        for name, time in zip(names, times):
            with h5py.File(directory / name) as file:
                self.assertEqual(int(file["trime_mpi"].attrs["retriangulation"]), time)
        grids = xml.etree.ElementTree.parse(directory / "m_series.xdmf").findall("./Domain/Grid/Grid")
        self.assertEqual([float(grid.find("Time").get("Value")) for grid in grids], times)
        for grid in grids:
            for item in grid.iter("DataItem"):
                name, path = item.text.split(":")
                with h5py.File(directory / name) as file:
                    self.assertEqual(" ".join(map(str, file[path].shape)), item.get("Dimensions"))

    def test_a_series_refuses_to_overwrite(self):
        with Workspace() as work:
            (work / "m_step_000400.h5").write_text("precious")
            done = run(CONFIG, f"meshing.points={POINTS}", f"output.directory={work}", "output.name=m",
                       "output.interval=-2")
            self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
            self.assertRegex(done.stderr, r"m_step_000400\.h5 exists.*overwrite")
            self.assertEqual([path.name for path in work.iterdir()], ["m_step_000400.h5"])
            self.run_config(work, "output.interval=-2", "output.overwrite=true")
            self.assertEqual(self.steps(work), [1])


if __name__ == "__main__":
    unittest.main()
