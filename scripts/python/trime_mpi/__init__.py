# SPDX-License-Identifier: BSD-3-Clause
"""Makes, reads and draws the triangle meshes of trime_mpi.

    import trime_mpi

    mesh = trime_mpi.mesh({"shape": {"geometry": "disc"},
                           "shape.disc": {"type": "circle", "center": (0.5, 0.5), "radius": 0.4},
                           "meshing": {"points": 20000}}, ranks=2)
    mesh.points, mesh.triangles, mesh.boundaries["disc"].facets
    trime_mpi.plot(mesh, "quality", file="disc.png")

read() returns a mesh file as NumPy arrays. mesh() runs the program, and raises its errors as exceptions. plot() draws
pictures.
"""
from .errors import (ConfigError, FileError, GeometryError, IncompleteError, InternalError, InterruptedRun, MemoryLimit,
                     ProgramMissing, StoppedAtCheckpoint, TrimeError)
from .errors import missing_module as _missing_module

try:
    from .read import Boundary, Check, Curve, Interface, Mesh, Verdict, read
    from .run import mesh
except ModuleNotFoundError as _error:  # h5py or numpy
    raise _missing_module(_error) from None

__all__ = ["Boundary", "Check", "ConfigError", "Curve", "FileError", "GeometryError", "IncompleteError", "Interface",
           "InternalError", "InterruptedRun", "MemoryLimit", "Mesh", "ProgramMissing", "StoppedAtCheckpoint",
           "TrimeError", "Verdict", "mesh", "plot", "read"]
__version__ = "0.1.0"


def plot(mesh, what="quality", file=None, dpi=130):  # pylint: disable=redefined-outer-name
    """Draws a mesh (a Mesh, or the path of its file), see trime_mpi.plots.plot. Needs matplotlib."""
    try:
        from .plots import plot as draw  # matplotlib is not needed before
    except ModuleNotFoundError as error:
        raise _missing_module(error) from None
    return draw(mesh, what, file, dpi)
