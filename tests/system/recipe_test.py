#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the first config of configs/README.md, and "From a map to a solver" of configs/shapes.md.

Config, commands and scripts run word for word, on a shapefile of islands with a lake, in degrees.
"""
import json
import pathlib
import re
import subprocess
import sys
import unittest

from trime_run import MPIEXEC, PROGRAM, ROOT, Workspace, environment

TIMEOUT = 300  # seconds, of a command


def blocks(title, language, page="shapes.md"):
    """The code of a section of a page of configs/."""
    text = (ROOT / "configs" / page).read_text(encoding="utf-8")
    section = re.search(rf"^##+ {title}\n(.*?)(?=^##)", text, re.MULTILINE | re.DOTALL)[1]
    return re.findall(rf"^```{language}\n(.*?)^```", section, re.MULTILINE | re.DOTALL)


def square(x, y, side):
    return [[x, y], [x + 2 * side, y], [x + 2 * side, y + side], [x, y + side], [x, y]]


class Recipe(unittest.TestCase):
    def run_in(self, work, *command):
        done = subprocess.run([str(word) for word in command], cwd=work, capture_output=True, text=True, check=False,
                              timeout=TIMEOUT, env=dict(environment(1), XDG_CACHE_HOME=str(work)))
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_first_config(self):
        with Workspace() as work:
            (work / "disc.ini").write_text(blocks("A first config", "ini", "README.md")[0])
            self.run_in(work, PROGRAM, "disc.ini")
            self.assertTrue((work / "out" / "disc.h5").exists())

    def test_word_for_word(self):
        features = [{"type": "Feature", "properties": {"name": name},
                     "geometry": {"type": "Polygon", "coordinates": rings}}
                    for name, rings in (("Main", [square(10, 60, 0.5), square(10.3, 60.2, 0.1)]),
                                        ("Isle", [square(11.3, 60.1, 0.2)]))]
        with Workspace() as work:
            (work / "map.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
            self.run_in(work, "ogr2ogr", "-f", "ESRI Shapefile", "coast.shp", "map.geojson")
            (work / "coast.prj").unlink()
            (work / "build").mkdir()
            (work / "build" / "release").symlink_to(pathlib.Path(PROGRAM).parent)
            (work / "scripts").symlink_to(ROOT / "scripts")
            title = "From a map to a solver"
            (work / "coast.ini").write_text(blocks(title, "ini")[0].replace("points = 20000", "points = 1000"))
            told = [self.run_in(work, "sh", "-c", line) for line in blocks(title, "sh")[0].splitlines()]
            self.assertIn("2 components, 1 hole", told[0])
            self.assertIn("1 land, 2 land.Main, 3 land.Isle", told[-1])
            self.assertGreater((work / "out" / "coast.png").stat().st_size, 10_000)
            (work / "coast.edp").write_text(blocks(title, "cpp")[0] + 'cout << "found " << u[].max << endl;\n')
            told = self.run_in(work, "FreeFem++", "-nw", "-v", "0", "coast.edp")
            largest = float(re.search(r"found (\S+)", told)[1])
            (work / "coast.py").write_text(blocks(title, "python")[0])
            for start in ((), (MPIEXEC, "-n", "2")):
                told = self.run_in(work, *start, sys.executable, "coast.py")
                self.assertAlmostEqual(float(told) / largest, 1, delta=1e-5)  # FreeFEM++ prints six digits


if __name__ == "__main__":
    unittest.main()
