# SPDX-License-Identifier: BSD-3-Clause
"""Makes meshes in place, on the ranks of a Python program: no subprocess, and no file.

    from mpi4py import MPI
    from trime_mpi import parallel

    plate = parallel.rectangle("plate", (0, 0), (2, 1)) - parallel.circle("hole", (1, 0.5), 0.2)
    mesh = parallel.mesh(MPI.COMM_WORLD, plate, points=20000, size=lambda p: 1 + 3 * p[:, 0])
    mesh.points, mesh.triangles        # the part of this rank
    domain = mesh.to_dolfinx()         # domain.mesh, domain.cell_tags, domain.facet_tags

All ranks of the communicator call mesh(), and other functions that are marked as collective, with the same arguments.
Needs the compiled module of the build, and mpi4py with the same MPI; see scripts/README.md.
"""
import functools
import importlib.machinery
import importlib.util
import os
import pathlib
import sys

import numpy as np

from .errors import IncompleteError, TrimeError
from .handover import Dolfinx, dolfinx_of, meshio_of
from .petsc import Petsc, petsc_of
from .read import Check, Verdict

NAME = "trime_mpi._parallel"
CELL_KINDS = ("voronoi", "whole", "triangles")


def find_module():
    """Returns the compiled module: the one in the folder of this file, or the one of a build in the source tree.
    TRIME_PYTHON_MODULE names a directory that comes first."""
    if NAME in sys.modules:  # a program that embeds Python may bring it
        return sys.modules[NAME]
    own = pathlib.Path(__file__).resolve().parent
    builds = [own.parents[2] / "build" / preset / "python" for preset in ("release", "ci")]
    for directory in (os.environ.get("TRIME_PYTHON_MODULE"), own, *builds):
        for suffix in importlib.machinery.EXTENSION_SUFFIXES:
            path = pathlib.Path(directory or own) / f"_parallel{suffix}"
            if path.exists():
                spec = importlib.util.spec_from_file_location(NAME, path)
                module = importlib.util.module_from_spec(spec)
                spec.loader.exec_module(module)
                return module
    raise ModuleNotFoundError(
        f"there is no compiled module {NAME} for {sys.executable}; trime_mpi.parallel needs a build with Python's "
        "headers and pybind11 (Debian: apt-get install python3-dev pybind11-dev; then build again). trime_mpi.mesh() "
        "runs the program instead", name=NAME)


_native = find_module()
Shape, Region, Curve = _native.Shape, _native.Region, _native.Curve


@functools.lru_cache(maxsize=None)
def check_library():
    """Raises TrimeError if mpi4py uses another MPI library than the compiled module."""
    from mpi4py import MPI  # the import starts MPI, unless mpi4py.rc says otherwise
    own, other = _native.mpi_library(), MPI.Get_library_version()
    if not other.startswith(own):
        raise TrimeError(["mpi4py uses another MPI library than trime_mpi: "
                          f"expected {own}, found {other.splitlines()[0]}"])


def rectangle(name, lower, upper):
    """Returns the rectangle with these corners, lower left and upper right."""
    return _native.rectangle(name, lower, upper)


def circle(name, center, radius):
    """Returns a disc."""
    return _native.circle(name, center, radius)


def polygon(name, *rings):
    """Returns the area in closed rings, which are arrays with the shape (n, 2). A ring inside of another is a hole."""
    return _native.rings(name, [np.asarray(ring, float) for ring in rings])


def triangle(name, a, b, c):
    """Returns the triangle with these corners."""
    return polygon(name, [a, b, c])


def contour(name, path):
    """Returns the rings of a file, see configs/shapes.md. Rank 0 reads it when the mesh is made."""
    return _native.contour(name, os.fspath(path))


def domain():
    """Returns the container itself, from which periodic shapes are made."""
    return _native.domain()


def automatic(gradation=0.1):
    """Returns a size that is small where the boundary has small features, and grows by `gradation` per length."""
    return (float(gradation),)


def curve(name, *lines, clip=False, split=False):
    """Returns a curve inside a shape, along which edges run. lines are arrays with the shape (n, 2)."""
    return Curve(name, [np.asarray(line, float) for line in lines], clip, split)


def mesh(comm, shape, *, size=None, **options):
    """Makes a mesh on all ranks of `comm`, a communicator of mpi4py. Returns this rank's part as a Mesh. Collective.

    size is the wanted edge length, up to a factor: None for the same everywhere, a formula as text ("1 + 3*x"),
    automatic(), or a function. The function gets an array of n places with the shape (n, 2), and returns n sizes. It
    must give a place the same size on every rank, and in every array. A dict {name: size} stands for the smallest one
    of several sizes, in the same order on all ranks; then size_shares of the mesh says how many points each of them
    decides. All of them must be lengths, or all relative, since their values are compared.

    Exactly one of points=N and edge_length=H must be given, or absolute_sizes=True. Other options are those of
    trime::MeshOptions: gradation, min_size, max_size, regions, curves, fixed_points (an array), container ((x, y), (x,
    y)), periodic_x, periodic_y, method, max_sweeps ...

    accept names models whose rules the mesh is measured by, such as ["adcirc", "fvcom"]; `verdicts` of the mesh has a
    Verdict for each rule. A rule that makes the model refuse the mesh is a check. The option split_ears=True divides
    triangles with two boundary edges, which some of these models refuse. The list open_boundary has the names of the
    open parts of the boundary, for these rules and for files of coastal models; see configs/formats.md. An empty list
    means that no part is open. None stands for the parts whose name has the word open, ocean or sea.

    start is an old mesh, of this function or of read(), or the path of a mesh file. Its points in the new shape are the
    first points of the new mesh. If shape and size differ little, this takes fewer sweeps than new points.

    Errors are the exceptions of trime_mpi, on all ranks. If an argument of one rank is wrong, this rank raises the
    TypeError or ValueError that says so, and the others a ConfigError that names the rank. If the function of the size
    fails on a rank, its own exception is the cause (`__cause__`) of the one on that rank. If a check of the mesh fails,
    IncompleteError has it as `mesh`.
    """
    check_library()
    start = options.pop("start", None)
    if start is not None:
        options["start"] = start._native if isinstance(start, Mesh) else _native.read_mesh(comm, os.fspath(start))
    made = Mesh(_native.make_mesh(comm, shape, size, options), comm)
    if not made.certified:
        failed = [f"{check.name}: expected {check.expected:g}, found {check.found:g}" for check in made.checks
                  if not check.passed]
        error = IncompleteError(failed or ["the sweeps reached max_sweeps before they converged"])
        error.mesh = made
        raise error
    return made


def read(comm, path):
    """Reads a mesh file on any number of ranks, and returns this rank's part as a Mesh. Collective."""
    check_library()
    return Mesh(_native.read_mesh(comm, os.fspath(path)), comm)


class Mesh:
    """One rank's part of a mesh. Each point, triangle and edge is owned by one rank.

    Local points are numbered from 0: first the owned ones, then ghosts, which other ranks own; both by global id.
    The triangles of this rank come first, then those of other ranks that touch a point of this rank. The arrays show
    the memory of the library, without a copy, and cannot be written. n is the number of local points, m that of
    local triangles, b that of local facets, which are edges on the boundary:

      points          [n,2]  coordinates
      triangles       [m,3]  local numbers of the vertices, counter-clockwise
      triangle_ids    [m]    global ids
      regions         [m]    number of the region, from 1; empty if there is only one
      ghost_ids       [g]    global ids of the ghosts
      ghost_owners    [g]    ranks that own the ghosts
      boundary        [n]    tag of the boundary loop, 0 inside
      facets          [b,2]  local numbers of the ends, the interior on the left
      facet_triangles [b]    local triangle of each facet
      facet_parts     [b]    number of the part of the shape, see facet_names
      curve_edges [c,2], curve_numbers [c]          edges on curves inside, see curve_names
      interfaces [i,2], interface_pairs [i]         edges between regions, see interface_names
      interface_curves [i]                          the curve that has the edge, too; -1: none

    owned_points, owned_triangles, owned_facets, owned_curve_edges and owned_interfaces count what this rank owns.
    first_point is the global id of the first point. total_points and total_triangles count over all ranks.

    `verdicts` says how well the mesh obeys the rules of models, see trime_mpi.read.Verdict. `size_shares` is a dict
    with the number of points that each of several sizes decides, by its section in a config, such as "size.wave".
    `sweeps` says how often the points were moved, 0 for a mesh that was read.

    The pair `periods` has the periods of the container, 0 where it is not periodic. Triangles across its border have
    points on both sides. Facets on a split curve have the number of parts plus that of the curve in facet_parts;
    facets_of finds them by the name of the curve.
    """

    def __init__(self, native, comm):
        self._native, self._local, self.comm = native, native.local(), comm
        self.hash, self.certified, self.quality = native.hash, native.certified, native.quality
        self.periods, self.sweeps = native.periods, native.sweeps
        self.checks = [Check(*row) for row in native.checks]
        self.verdicts = [Verdict(*row) for row in native.verdicts]
        self.size_shares = native.size_shares
        for kind, names in native.names.items():
            setattr(self, {"facets": "facet", "regions": "region", "curves": "curve", "interfaces": "interface",
                           "split_curves": "split_curve"}[kind] + "_names", names)

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._local, name)

    def __dir__(self):
        return sorted({*super().__dir__(), *(name for name in dir(self._local) if not name.startswith("_"))})

    def __repr__(self):
        return (f"<trime_mpi.parallel.Mesh: {self.owned_points} of {self.total_points} points, "
                f"{self.owned_triangles} of {self.total_triangles} triangles, hash {self.hash}>")

    @functools.cached_property
    def global_ids(self):
        """The global ids of all local points [n]."""
        return self._local.global_ids()

    def facets_of(self, name):
        """Returns the rows of `facets` on the part of the boundary or the split curve with this name, ghosts among
        them."""
        names = [*self.facet_names, *(name for name in self.curve_names if name in self.split_curve_names)]
        number = self._number(name, names, "boundary")
        if number >= len(self.facet_names):
            number = len(self.facet_names) + self.curve_names.index(name)
        return np.flatnonzero(self.facet_parts == number)

    def region_of(self, name):
        """Returns the local triangles of the region with this name."""
        number = self._number(name, self.region_names, "region") + 1
        return np.flatnonzero(self.regions == number) if len(self.regions) else np.arange(len(self.triangles))

    @staticmethod
    def _number(name, names, kind):
        if name not in names:
            raise KeyError(f"the mesh has no {kind} '{name}'; known: {', '.join(names)}")
        return names.index(name)

    def update_ghosts(self, values):
        """Sets the values of ghosts to those at their owners, in place. values is an array of doubles with a row for
        each local point. Collective."""
        self._local.update_ghosts(values)

    def add_to_owners(self, values):
        """Adds the values of ghosts to those at their owners, in place. Collective."""
        self._local.add_to_owners(values)

    def cells(self):
        """Returns the Voronoi cells of the points of this rank as Cells, for finite volumes. Collective."""
        return Cells(self._native.cells())

    def write(self, path, overwrite=False, vtkhdf=True, xdmf=True, voronoi=False, cells="voronoi"):
        """Writes the whole mesh to a file: `.h5`, or the ending of another format, see configs/formats.md.
        Collective.

        @param voronoi: add the Voronoi cells to an `.h5` file, as the group /Cells
        @param cells: `voronoi`, `whole` or `triangles`, the cells in files of MPAS, MODFLOW 6, PFLOTRAN and TOUGH2
        """
        if cells not in CELL_KINDS:
            raise ValueError(f"cells = {cells!r}: expected one of {', '.join(CELL_KINDS)}")
        self._native.write(os.fspath(path), overwrite, vtkhdf, xdmf, voronoi, cells)

    def to_meshio(self):
        """Returns the owned triangles and edges of this rank as a meshio.Mesh, with global ids and names."""
        return meshio_of(self)

    def to_petsc(self) -> Petsc:
        """Returns the mesh as a DMPlex of PETSc with labels, see trime_mpi.petsc.Petsc. Collective.

        Each rank keeps its triangles, and shares the vertices and edges between ranks as PETSc wants it. Needs
        petsc4py with the same MPI.
        """
        return petsc_of(self)

    def to_dolfinx(self, ghost_mode="none") -> Dolfinx:
        """Returns the mesh for dolfinx, with tags, see trime_mpi.handover.Dolfinx. Collective.

        Each rank keeps its triangles. ghost_mode is that of dolfinx: integrals over inner facets (dS) need
        "shared_facet".
        """
        return dolfinx_of(self, ghost_mode)


class Cells:
    """The Voronoi cells of the points of one rank's part of a mesh. Cell i is that of local point i of the Mesh, whose
    numbers of points, triangles and facets are used here. The arrays show the memory of the library, without a copy,
    and cannot be written. c is the number of owned points, n that of local points, f that of faces:

      areas           [n]    of cells; those of ghosts too
      centroids       [n,2]
      vertices        [v,2]  corners of polygons; row t is the circumcentre of the local triangle t
      corner_first [c+1], corners [-]               the polygon of cell i is corners[corner_first[i]:corner_first[i+1]],
                                                    counter-clockwise; see polygon()
      part_first [c+1], part_regions, part_areas [p], part_centroids [p,2]   parts of cells, one unless regions meet
      part_corner_first [p+1], part_corners [-]     polygons of the parts
      faces           [f,2]  the two cells (local points) of each face; the lower global id comes first
      face_arms       [f,2]  vector from the first site to the second, normal to the face
      face_lengths [f,2], face_regions [f,2]        length of the face in each of two regions; 0 and 0: only one
      face_vertices   [f,2]  ends of the face, on the right and on the left of the arm
      neighbour_first [c+1], neighbours, neighbour_faces [-]   the neighbours of a cell, counter-clockwise
      chord_cells, chord_facets [h], chord_normals [h,2]       halves of boundary edges; outward, as long as the half

    owned_cells and owned_faces count what this rank owns; other faces follow the owned ones. A flux of the size
    k d / l through a face, with d from face_lengths, l the length of the arm, and the k of each region, is exact for
    functions that are linear in each region.
    """

    def __init__(self, native):
        self._native = native

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._native, name)

    def __dir__(self):
        return sorted({*super().__dir__(), *(name for name in dir(self._native) if not name.startswith("_"))})

    def polygon(self, cell):
        """Returns the corners of a cell as an array with the shape (k, 2)."""
        return self.vertices[self.corners[self.corner_first[cell]:self.corner_first[cell + 1]]]
