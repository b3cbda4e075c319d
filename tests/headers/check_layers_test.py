#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that scripts/check_layers.py finds forbidden includes."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_layers.py"


def run(files):
    """Exit code and output of the script on a tree of {path: text}."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            file = pathlib.Path(root, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class Layers(unittest.TestCase):
    def assert_refused(self, path, include, reason):
        code, output = run({path: f"#pragma once\n{include}\n"})
        self.assertEqual(code, 1, output)
        self.assertIn(f"{path}:2:", output)
        self.assertIn(reason, output)

    def assert_allowed(self, path, include):
        _, output = run({path: include + "\n", "src/core/plain.cpp": "\n"})
        self.assertNotIn(f"{path}:1:", output)  # the small tree lacks most includes: their arrows are complained of

    def test_upward_and_sideward_includes_are_refused(self):
        for path, header in [
            ("include/trime/core/a.hpp", "trime/geometry/vec2.hpp"),
            ("include/trime/delaunay/a.hpp", "trime/comm/communicator.hpp"),
            ("src/delaunay/a.cpp", "decomposition/halo.hpp"),
            ("src/decomposition/a.cpp", "trime/delaunay/star.hpp"),
            ("src/io/a.cpp", "trime/meshing/options.hpp"),
            ("src/meshing/a.cpp", "trime/io/mesh_file.hpp"),
            ("src/mesh/a.cpp", "trime/sizing/size_field.hpp"),
            ("src/io/a.cpp", "app/config_table.hpp"),
            ("src/geometry/a.cpp", "trime/shape/shape.hpp"),
            ("src/cones/a.cpp", "trime/sizing/size_field.hpp"),
            ("src/boundary/a.cpp", "sites/stage.hpp"),
            ("src/sites/a.cpp", "boundary/boundary_layout.hpp"),
            ("src/sweep/a.cpp", "boundary/boundary_layout.hpp"),
            ("src/cleanup/a.cpp", "sweep/sweeper.hpp"),
            ("src/certificate/a.cpp", "extraction/extraction.hpp"),
            ("src/start/a.cpp", "trime/shape/shape.hpp"),
            ("src/sweep/a.cpp", "trime/meshing/options.hpp"),
        ]:
            with self.subTest(path=path, header=header):
                self.assert_refused(path, f'#include "{header}"', "may include headers of")

    def test_the_verifier_shares_no_code(self):
        for header in ("trime/geometry/vec2.hpp", "io/hdf5_handle.hpp", "core/random.hpp"):
            self.assert_refused("src/check/a.cpp", f'#include "{header}"', "shares no code")
        self.assert_allowed("src/check/a.cpp", "#include <hdf5.h>")

    def test_the_arrows_of_a_module_are_allowed(self):
        for path, header in [
            ("src/meshing/a.cpp", "trime/geometry/predicates.hpp"),
            ("src/app/main.cpp", "trime/core/error.hpp"),
            ("src/decomposition/a.cpp", "trime/comm/communicator.hpp"),
            ("src/io/a.cpp", "comm/native.hpp"),
            ("src/bench/a.cpp", "trime/io/mesh_file.hpp"),
        ]:
            with self.subTest(path=path, header=header):
                self.assert_allowed(path, f'#include "{header}"')

    def test_foreign_headers_stay_in_their_module(self):
        for path, include, reason in [
            ("src/meshing/a.cpp", "#include <mpi.h>", "MPI"),
            ("src/app/a.cpp", "#  include <hdf5.h>", "HDF5"),
            ("src/comm/a.cpp", "#include <H5Fpublic.h>", "HDF5"),
            ("src/delaunay/a.cpp", "#include <omp.h>", "OpenMP"),
            ("src/meshing/a.cpp", '#include "comm/native.hpp"', "MPI handle"),
        ]:
            with self.subTest(path=path, include=include):
                self.assert_refused(path, include, reason)
        self.assert_allowed("src/comm/a.cpp", "#include <mpi.h>")
        self.assert_allowed("src/io/a.cpp", "#include <hdf5.h>")

    def test_public_headers_cannot_include_private_ones(self):
        self.assert_refused("include/trime/io/a.hpp", '#include "io/hdf5_handle.hpp"', "private")

    def test_an_arrow_is_direct(self):
        # meshing -> fitting -> generalise, and meshing has no arrow to generalise of its own.
        self.assert_refused("src/meshing/a.cpp", '#include "generalise/generalise.hpp"', "may include headers of")

    def test_an_arrow_that_no_include_uses_is_refused(self):
        code, output = run({"src/tracing/a.cpp": "\n"})
        self.assertEqual(code, 1)
        self.assertIn("tracing includes nothing of geometry: remove that arrow", output)

    def test_neighbours_in_one_folder_may_be_named_without_it(self):
        files = {"src/io/a.cpp": '#include "b.hpp"\n', "src/io/b.hpp": "\n"}
        self.assertNotIn("src/io/a.cpp", run(files)[1])
        files = {"src/io/a.cpp": '#include "../app/b.hpp"\n', "src/app/b.hpp": "\n"}
        self.assertEqual(run(files)[0], 1, "a way around the check")

    def test_unknown_modules_and_an_empty_tree_are_refused(self):
        self.assert_refused("src/io/a.cpp", '#include "handle.hpp"', "is not a module")
        self.assertEqual(run({"src/solver/a.cpp": "\n"})[0], 1)
        self.assertEqual(run({"readme": "\n"})[0], 1)


if __name__ == "__main__":
    unittest.main()
