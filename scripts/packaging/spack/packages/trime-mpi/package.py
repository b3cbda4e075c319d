# SPDX-License-Identifier: BSD-3-Clause
"""Spack recipe of TriMe-MPI; see scripts/packaging/README.md."""
import os

from spack.package import *


class TrimeMpi(CMakePackage):
    """Distributed generator of large 2D triangle meshes, with MPI, OpenMP and HDF5."""

    # No release to fetch yet: the sources are the tree that this recipe lies in.
    git = "file://" + os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 5))

    version("develop")

    license("BSD-3-Clause")

    variant("shared", default=False, description="Build the library as a shared one")
    variant("examples", default=False, description="Build the programs of src/examples")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("python@3:", type="build")  # the man page
    depends_on("mpi@3:")
    depends_on("hdf5@1.10: +mpi")
    depends_on("fmt@9:")
    depends_on("cli11@2:", type="build")
    depends_on("muparser@2.3:")
    depends_on("proj@9:")
    depends_on("shapelib@1.5:")
    depends_on("nlohmann-json@3:", type="build")

    conflicts("%gcc@:11", msg="C++20 is needed: gcc 12 or later")
    conflicts("%clang@:13", msg="C++20 is needed: clang 14 or later")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("TRIME_BUILD_TESTS", False),
            self.define("TRIME_BUILD_BENCHMARKS", False),
            self.define_from_variant("TRIME_BUILD_EXAMPLES", "examples"),
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
        ]
