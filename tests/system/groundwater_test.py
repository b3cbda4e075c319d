#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Follows the page on formats as a groundwater modeller: its config and its Python make a model of MODFLOW 6.

Debian has no flopy, so a recorder of calls stands in for it.
"""
import json
import math
import os
import re
import subprocess
import sys
import unittest

import h5py
import numpy as np

from cell_readers import Disv
from trime_run import ROOT, Workspace, run

RECORDER = """
import json
def package(name):
    def call(model=None, **values):
        with open("calls.json", "a", encoding="utf-8") as file:
            file.write(json.dumps([name, values]) + "\\n")
        return name
    return call
def __getattr__(name):
    return package(name)
"""
WELLS = [(449000.5, 5601500.25), (451200.0, 5598800.0), (452500.75, 5601000.5)]


def feature(shape, coordinates, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": shape, "coordinates": coordinates}}


def write_map(path, features):
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))


def catchment():
    """300 vertices around (450 km, 5600 km)."""
    rng = np.random.default_rng(3)
    t = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    r = 4000 * (1 + 0.15 * np.cos(3 * t + 0.4) + 0.08 * np.sin(5 * t)) + rng.normal(0, 25, 300)
    return np.column_stack([450000 + 1.3 * r * np.cos(t), 5600000 + r * np.sin(t)]).tolist()


class Groundwater(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.space = Workspace()
        cls.directory = cls.space.__enter__()
        page = (ROOT / "configs" / "formats.md").read_text(encoding="utf-8").split("### A groundwater model")[1]
        config, script = (re.search(f"```{kind}\n(.*?)```", page, re.DOTALL)[1] for kind in ("ini", "python"))
        ring = catchment()
        write_map(cls.directory / "catchment.geojson", [
            feature("LineString", ring[200:241], kind="inflow"),
            feature("LineString", ring[240:] + ring[:201], kind="divide")])
        border = [[449800, 5590000], [450300, 5600500], [449500, 5610000]]
        write_map(cls.directory / "geology.geojson", [
            feature("Polygon", [[[440000, 5590000]] + border + [[440000, 5610000], [440000, 5590000]]], unit="gravel"),
            feature("Polygon", [border[:1] + [[460000, 5590000], [460000, 5610000]] + border[::-1]], unit="clay")])
        s = np.linspace(-9000, 3200, 60)  # begins outside of the catchment
        cls.river = np.column_stack([450000 + s, 5600000 + 600 * np.sin(s / 1500) + 0.1 * s])
        np.savetxt(cls.directory / "river.xy", cls.river)
        (cls.directory / "wells.xy").write_text("".join(f"{x} {y}\n" for x, y in WELLS))
        (cls.directory / "valley.ini").write_text(config)
        cls.done = run("valley.ini", ranks=2, cwd=cls.directory)
        (cls.directory / "flopy").mkdir()
        (cls.directory / "flopy" / "__init__.py").write_text("from . import mf6\n")
        (cls.directory / "flopy" / "mf6.py").write_text(RECORDER)
        (cls.directory / "valley.py").write_text(script)

    @classmethod
    def tearDownClass(cls):
        cls.space.__exit__()

    def model(self):
        done = subprocess.run([sys.executable, "valley.py"], cwd=self.directory, text=True, capture_output=True,
                              env={**os.environ, "PYTHONPATH": "."}, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = [json.loads(line) for line in (self.directory / "calls.json").read_text().splitlines()]
        return dict(calls)

    def test_the_page_makes_a_model(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)
        model = self.model()
        grid = Disv(self.directory / "out" / "valley.disv")
        disv = model["ModflowGwfdisv"]
        self.assertEqual([row[4:] for row in disv["cell2d"]], [list(cell) for cell in grid.cells])
        self.assertEqual([row[1:] for row in disv["vertices"]], grid.vertices.tolist())
        self.assertEqual(len(model["ModflowGwfnpf"]["k"]), len(grid.cells))
        west = grid.places[:, 0] < 449000
        self.assertTrue((np.array(model["ModflowGwfnpf"]["k"])[west] == 40).all())

    def test_conditions_lie_where_the_map_has_them(self):
        model = self.model()
        places = np.array([row[1:3] for row in model["ModflowGwfdisv"]["cell2d"]])
        wells = [cell for (_, cell), _ in model["ModflowGwfwel"]["stress_period_data"]]
        np.testing.assert_allclose(places[wells], WELLS, rtol=0, atol=1e-6)
        with h5py.File(self.directory / "out" / "valley.h5") as file:
            size = file["/VTKHDF/PointData/size"][:]
            names = [name.decode() for name in file["/trime_mpi/tags/part_name"]]
            parts, ends = file["/Mesh/facets/parts"][:], file["/Mesh/facets/topology"][:]
        self.assertTrue((size[wells] <= 20.001).all())
        river = model["ModflowGwfriv"]["stress_period_data"]
        lengths = {cell: conductance / 3 for (_, cell), _, conductance, _ in river}
        inside = sum(math.dist(a, b) for a, b in zip(self.river, self.river[1:]) if a[0] > 446000)
        self.assertGreater(sum(lengths.values()), 0.99 * inside)
        on_line = np.interp(places[list(lengths), 0], self.river[:, 0], self.river[:, 1])
        self.assertLess(np.abs(places[list(lengths), 1] - on_line).max(), 40)
        inflow = {cell for (_, cell), _, _ in model["ModflowGwfghb"]["stress_period_data"]}
        self.assertEqual(inflow, set(ends[parts == names.index("catchment.inflow")].ravel().tolist()))


if __name__ == "__main__":
    unittest.main()
