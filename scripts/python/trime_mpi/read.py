# SPDX-License-Identifier: BSD-3-Clause
"""Reads a mesh file of trime_mpi as NumPy arrays."""
import dataclasses
import functools
import os

import h5py
import numpy as np

from .errors import FileError


def no_rows(columns, kind=np.int32):
    """Returns the default of a member that is an array: one without rows."""
    return dataclasses.field(default_factory=lambda: np.zeros((0, columns) if columns else 0, kind))


@dataclasses.dataclass(frozen=True)
class Check:
    """A check of the certificate: what it expected, what it found, and what that means."""
    name: str
    passed: bool
    expected: float
    found: float
    meaning: str


@dataclasses.dataclass(frozen=True)
class Verdict:
    """How well a mesh obeys one rule of a model of coasts or oceans, see `accept` in configs/formats.md.

    The text solver names the model, and rule what is limited, such as "least_angle". If is_least is True, limit is the
    smallest allowed value, otherwise the largest one. The worst value lies at place (x, y); a rule about the whole mesh
    has no place. The numbers broken and measured count triangles, points or pairs. If refuses is True, the model stops
    where the rule is broken.
    """
    solver: str
    rule: str
    is_least: bool
    limit: float
    worst: float
    broken: int
    measured: int
    refuses: bool
    place: tuple | None

    @property
    def holds(self):
        """True if nothing breaks the rule."""
        return self.broken == 0


def verdicts_of(table):
    """Returns the rows of the table `accept` of a file as a list of Verdict."""
    columns = [table.get(name, []) for name in ("solver", "rule", "is_least", "limit", "worst", "broken", "measured",
                                                "refuses", "x", "y")]
    return [Verdict(solver, rule, bool(is_least), float(limit), float(worst), int(broken), int(measured), bool(refuses),
                    (float(x), float(y)) if np.isfinite([x, y]).all() else None)
            for solver, rule, is_least, limit, worst, broken, measured, refuses, x, y in zip(*columns)]


@dataclasses.dataclass(frozen=True)
class Boundary:
    """The boundary edges that follow one part of the shape.

    facets [k,2] holds the two vertices of each edge, with the interior on its left. rows [k] are the rows of these
    edges in Mesh.facets. vertices [v] holds each vertex of them once, in ascending order.
    """
    name: str
    rows: np.ndarray
    facets: np.ndarray

    @functools.cached_property
    def vertices(self):
        """The ids of the vertices of the facets, each once."""
        return np.unique(self.facets)


@dataclasses.dataclass(frozen=True)
class Curve:
    """The edges on a curve inside the shape.

    edges [k,2] holds the two vertices of each edge, in the direction of the curve. rows [k] are the rows of these edges
    in Mesh.curve_edges. label is their label in the formats of other programs.
    """
    name: str
    label: int
    rows: np.ndarray
    edges: np.ndarray

    @functools.cached_property
    def vertices(self):
        """The ids of the vertices of the edges, each once."""
        return np.unique(self.edges)


@dataclasses.dataclass(frozen=True)
class Interface(Curve):
    """The edges between two regions, as for a Curve; rows are those in Mesh.interface_edges.

    left and right are the names of the regions on both sides of each edge. left has the lower number.
    """
    left: str
    right: str


@dataclasses.dataclass
class Mesh:
    """A triangle mesh of N points, M triangles and B boundary edges, with C edges on curves and I edges between regions
    inside. Ids count from 0.

      points        [N,2]      coordinates
      triangles     [M,3]      vertices, counter-clockwise
      alpha, beta   [M]        quality of the triangles
      region        [M]        number of the region, see regions
      boundary      [N]        tag of the boundary loop of a point, 0 inside
      size          [N]        wanted edge length
      fixed         [N]        True for corners and fixed points
      facets        [B,2]      vertices of the boundary edges
      facet_tags    [B]        tag of the boundary loop, see loops
      facet_parts   [B]        number of the part of the shape, see parts
      facet_size    [B]        wanted edge length
      curve_edges   [C,2]      vertices of the edges on curves, see curves
      curve_numbers [C]        number of the curve
      interface_edges   [I,2]  vertices of the edges between regions, the lower region on the left, see interfaces
      interface_regions [I,2]  numbers of the regions on the left and on the right
      interface_pairs   [I]    number of the pair of regions
      interface_curves  [I]    number of the curve on which the edge lies, -1 if there is none
      split_pairs   [K,2]      points on the left and on the right of curves that are split
      split_curves  [K]        number of the curve of each pair
      split_paths   [K]        number of the path of each pair, see configs/curves.md
      first_point   [ranks]    first point of each rank that made the mesh

    attributes and tables hold the group /trime_mpi of the file; a table is a dict of columns. config is the config as
    the user gave it, and config_resolved the same config with all defaults. warnings are those of the run.
    """
    path: str
    points: np.ndarray
    triangles: np.ndarray
    alpha: np.ndarray
    beta: np.ndarray
    region: np.ndarray
    boundary: np.ndarray
    size: np.ndarray
    fixed: np.ndarray
    facets: np.ndarray
    facet_tags: np.ndarray
    facet_parts: np.ndarray
    facet_size: np.ndarray
    first_point: np.ndarray
    attributes: dict
    tables: dict
    config: str
    config_resolved: str
    warnings: list = dataclasses.field(default_factory=list)
    curve_edges: np.ndarray = no_rows(2, np.int64)
    curve_numbers: np.ndarray = no_rows(0)
    interface_edges: np.ndarray = no_rows(2, np.int64)
    interface_regions: np.ndarray = no_rows(2)
    interface_pairs: np.ndarray = no_rows(0)
    interface_curves: np.ndarray = no_rows(0)
    split_pairs: np.ndarray = no_rows(2, np.int64)
    split_curves: np.ndarray = no_rows(0)
    split_paths: np.ndarray = no_rows(0)

    def __repr__(self):
        return (f"<trime_mpi.Mesh of {len(self.points)} points, {len(self.triangles)} triangles, "
                f"{len(self.facets)} boundary edges, hash {self.hash}>")

    @property
    def hash(self):
        """The hash of points and triangles, 16 hexadecimal digits. Meshes with equal hashes are equal."""
        if "mesh_hash_hex" in self.attributes:
            return self.attributes["mesh_hash_hex"]
        return f"{int(self.attributes['mesh_hash']) & 0xffffffffffffffff:016x}"

    @property
    def is_complete(self):
        """False if the run stopped at its largest number of sweeps, or if a check failed."""
        return bool(self.attributes.get("complete", 0))

    @property
    def periods(self):
        """The periods (x, y) of the container; 0 where it is not periodic."""
        return float(self.attributes.get("period_x", 0)), float(self.attributes.get("period_y", 0))

    @functools.cached_property
    def verdicts(self):
        """How well the mesh obeys the rules of the models in `accept`: a list of Verdict."""
        return verdicts_of(self.tables.get("accept", {}))

    @functools.cached_property
    def size_shares(self):
        """The number of points that each of several sizes decides, by its section in the config; empty for one size."""
        table = self.tables.get("sizes", {})
        return dict(zip(table.get("name", ()), map(int, table.get("points", ()))))

    @functools.cached_property
    def parts(self):
        """The names of the parts of the shape, by their number in facet_parts."""
        tags = self.tables.get("tags", {})
        return {int(number): name for number, name in zip(tags.get("part_id", ()), tags.get("part_name", ()))}

    @functools.cached_property
    def regions(self):
        """The names of the regions of triangles, by their number in region."""
        tags = self.tables.get("tags", {})
        return {int(number): name for number, name in zip(tags.get("region_id", ()), tags.get("region_name", ()))}

    def in_region(self, name):
        """Returns for each triangle whether it lies in the region with this name, or in one of a list of names.

        Raises KeyError for an unknown name.
        """
        numbers = {name: number for number, name in self.regions.items()}
        return np.isin(self.region, [numbers[one] for one in ([name] if isinstance(name, str) else name)])

    @functools.cached_property
    def curves(self):
        """The Curve of each curve inside the shape that has an edge, by its name."""
        table = self.tables.get("curves", {})
        columns = [table.get(column, ()) for column in ("curve_id", "curve_name", "label")]
        rows = rows_by_number(self.curve_numbers)
        return {name: Curve(name, int(label), rows[number], self.curve_edges[rows[number]])
                for number, name, label in zip(*columns) if number in rows}

    @functools.cached_property
    def interfaces(self):
        """The Interface of each pair of regions that has an edge, by its name, such as rock|soil."""
        table = self.tables.get("interfaces", {})
        columns = [table.get(column, ()) for column in ("pair_id", "pair_name", "label", "left", "right")]
        rows, names = rows_by_number(self.interface_pairs), self.regions
        return {name: Interface(name, int(label), rows[number], self.interface_edges[rows[number]], names[left],
                                names[right])
                for number, name, label, left, right in zip(*columns) if number in rows}

    @functools.cached_property
    def boundaries(self):
        """The Boundary of each part of the shape that has an edge, by the name of the part. Curves that are split have
        one, too, with the edges on both of their sides."""
        found, names = {}, dict(self.parts)
        names.update(enumerate(self.tables.get("curves", {}).get("curve_name", ()), len(names)))
        for number, rows in rows_by_number(self.facet_parts).items():
            name = names.get(number, f"part {number}")
            found[name] = Boundary(name, rows, self.facets[rows])
        return found

    @functools.cached_property
    def loops(self):
        """A dict of name, kind (outer, hole, band), edges and length for each boundary loop, by its tag."""
        tags = self.tables.get("tags", {})
        columns = [tags.get(name, ())
                   for name in ("edge_id", "edge_name", "edge_kind", "edge_count", "edge_length_sum")]
        return {int(tag): {"name": name, "kind": kind, "edges": int(edges), "length": float(length)}
                for tag, name, kind, edges, length in zip(*columns)}

    @functools.cached_property
    def checks(self):
        """The Check objects of the certificate, by name."""
        table = self.tables.get("checks", {})
        columns = [table.get(name, ()) for name in ("name", "passed", "expected", "found", "meaning")]
        return {name: Check(name, bool(passed), float(expected), float(found), meaning)
                for name, passed, expected, found, meaning in zip(*columns)}

    @property
    def history(self):
        """The columns of the records of the run: sweep, stage, points, median_alpha, max_alpha, moving_share, ..."""
        return self.tables.get("history", {})

    @property
    def quality(self):
        """The summary of the quality: its attributes and columns by name."""
        return self.tables.get("quality", {})

    @functools.cached_property
    def counters(self):
        """The counters as counters[phase][name]: a dict of unit, and of sum, min, mean, max over the ranks. The phase
        `run` is the whole run."""
        table, nested = self.tables.get("counters", {}), {}
        rows = zip(*(table.get(name, ()) for name in ("phase", "name", "unit", "sum", "min", "mean", "max")))
        for phase, name, unit, *values in rows:
            nested.setdefault(phase, {})[name] = {"unit": unit} | dict(zip(("sum", "min", "mean", "max"), values))
        return nested

    @functools.cached_property
    def timers(self):
        """A dict of calls, and of min, avg, max over the ranks in seconds, by phase."""
        table = self.tables.get("timers", {})
        columns = [name for name in table if name != "name"]
        return {row[0]: dict(zip(columns, row[1:])) for row in zip(table.get("name", ()), *(table[c] for c in columns))}

    def corners(self, chosen=slice(None)):
        """The coordinates of the corners of triangles [M,3,2]. In a periodic container the corners of a triangle lie
        next to each other."""
        return brought_together(self.points[self.triangles[chosen]], self.periods)

    def facet_ends(self, chosen=slice(None)):
        """The coordinates of the ends of facets [B,2,2], with the same rule for periodic containers."""
        return self.edge_ends(self.facets[chosen])

    def edge_ends(self, edges):
        """The coordinates of the ends of edges [k,2], such as curve_edges, with the same rule."""
        return brought_together(self.points[edges], self.periods)

    def ranks(self):
        """The rank of each point [N]. A triangle belongs to the rank of its first vertex."""
        return np.repeat(np.arange(len(self.first_point), dtype=np.int32),
                         np.diff(np.append(self.first_point, len(self.points))))


def rows_by_number(numbers):
    """Returns the rows in which each number stands, by the number, ascending."""
    order = np.argsort(numbers, kind="stable")
    different, first = np.unique(numbers[order], return_index=True)
    return dict(zip(map(int, different), np.split(order, first[1:])))


def brought_together(places, periods):
    """Replaces places [..., k, 2] by their periodic images that are nearest to the first of each k."""
    for axis, period in enumerate(periods):
        if period > 0:
            first = places[:, :1, axis]
            places[:, :, axis] -= period * np.round((places[:, :, axis] - first) / period)
    return places


def python_value(value):
    """Returns an attribute as a number or a str."""
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace")
    return value.item() if isinstance(value, np.generic) else value


def column_values(dataset):
    """Returns a column as an array of numbers, or as a list of str."""
    values = dataset[()]
    if dataset.dtype.kind in "OS":
        return [python_value(value) for value in np.atleast_1d(values)]
    return values


def text_of(group, name):
    """Returns a text of /trime_mpi, or an empty one if the file does not have it."""
    return python_value(group[name][()]) if name in group else ""


def read_tables(group):
    """Returns the groups of /trime_mpi as {name: {attribute or column: values}}."""
    tables = {}
    for name, inner in group.items():
        if isinstance(inner, h5py.Group):
            tables[name] = {key: python_value(value) for key, value in inner.attrs.items()}
            tables[name].update((key, column_values(values)) for key, values in inner.items())
    return tables


def loaded(dataset):
    """Returns the values of a dataset in memory."""
    return dataset[:]


def mapped(dataset):
    """Returns the values of a dataset as a map of the file, from which they are read when they are used. Changes of
    them stay in memory."""
    offset = dataset.id.get_offset()  # None if they are in chunks
    if offset is None or dataset.size == 0 or not dataset.dtype.isnative:
        return loaded(dataset)
    return np.memmap(dataset.file.filename, dataset.dtype, "c", offset, dataset.shape).view(np.ndarray)


def ids_in(dataset, take):
    """Returns numbers of points: in memory as int64, so that products of them do not overflow, and in place in the type
    that the file has."""
    values = take(dataset)
    return values.astype(np.int64, copy=False) if take is loaded else values


# Arrays of /Mesh, by member.
INNER_EDGES = {"curves": {"curve_edges": "topology", "curve_numbers": "values"},
               "interfaces": {"interface_edges": "topology", "interface_regions": "regions",
                              "interface_pairs": "values", "interface_curves": "curves"},
               "splits": {"split_pairs": "pairs", "split_curves": "curves", "split_paths": "paths"}}


def read_open(file, path, take):
    """Returns the mesh of an open file. take: returns the values of a dataset."""
    about = file["trime_mpi"]
    if "Mesh/mesh" in file:
        points, triangles = take(file["Mesh/mesh/geometry"]), ids_in(file["Mesh/mesh/topology"], take)
    else:  # written for ParaView only
        points = take(file["VTKHDF/Points"])[:, :2]
        triangles = ids_in(file["VTKHDF/Connectivity"], take).reshape(-1, 3)
    fields = file["VTKHDF" if "VTKHDF/PointData" in file else "Mesh"]
    cells, nodes, facets = fields["CellData"], fields["PointData"], file["Mesh/facets"]
    tables, inner = read_tables(about), {}
    for group, names in INNER_EDGES.items():
        if group in file["Mesh"]:
            inner.update((member, take(file["Mesh"][group][array])) for member, array in names.items())
    first = np.asarray(tables.pop("ranks", {}).get("first_point", [0]))
    return Mesh(
        path=os.fspath(path), points=points, triangles=triangles, alpha=take(cells["alpha"]), beta=take(cells["beta"]),
        region=take(cells["region"]), boundary=take(nodes["boundary"]), size=take(nodes["size"]),
        fixed=take(nodes["fixed"]).astype(bool), facets=take(facets["topology"]), facet_tags=take(facets["values"]),
        facet_parts=take(facets["parts"]),
        facet_size=take(facets["asked_size"]) if "asked_size" in facets else np.zeros(0, np.float32), first_point=first,
        attributes={key: python_value(value) for key, value in about.attrs.items()}, tables=tables,
        config=text_of(about, "config_text"), config_resolved=text_of(about, "config_resolved"), **inner)


def read(file, in_place=False):
    """Reads the mesh in a file NAME.h5 (or NAME.vtkhdf) of trime_mpi. The arrays take about 100 bytes per point.

    in_place: the arrays stay in the file, and are read when they are used; triangles are int32 if the file has them so,
    otherwise they are int64. Nothing may write to the file meanwhile. A
    run that makes the mesh again does no harm, since it makes a new file of the same name.

    Raises FileError if the file does not exist, or if it is not a mesh of trime_mpi.
    """
    path = os.fspath(file)
    if not os.path.exists(path):
        raise FileError([f"there is no {path}"])
    try:
        with h5py.File(path, "r") as opened:
            return read_open(opened, path, mapped if in_place else loaded)
    except (OSError, KeyError) as error:
        raise FileError([f"{path} is not a mesh file of trime_mpi: {error}"]) from error
