# SPDX-License-Identifier: BSD-3-Clause
"""Writes outlines and points as files that trime_mpi reads: arrays as .xy, polygons as .geojson."""
import collections.abc
import json

import numpy as np

from .errors import ConfigError


def coordinates(value, where):
    """An array [k,2] of x and y, k > 0, of anything that NumPy takes for one."""
    try:
        array = np.asarray(value, float)
    except (TypeError, ValueError) as error:
        raise ConfigError([f"{where}: expected x and y of each point, an array [k,2], found something else: "
                           f"{error}"]) from error
    if array.ndim != 2 or array.shape[1] != 2 or len(array) == 0:
        extra = "; leave out the third column" if array.ndim == 2 and array.shape[1] == 3 else ""
        raise ConfigError([f"{where}: expected x and y of each point, an array with the shape (k, 2), found the shape "
                           f"{array.shape}{extra}"])
    return array


def xy_text(array):
    """Lines `x y`; floats keep all their bits."""
    return "".join(f"{x!r} {y!r}\n" for x, y in array.tolist())


def points_text(points, where):
    """The text of an .xy file for points [k,2]."""
    return xy_text(coordinates(points, where))


def geo_interface(value):
    """The dict of an object that has GeoJSON's form: of shapely, geopandas and others, or a dict; None for others."""
    value = getattr(value, "__geo_interface__", value)
    return value if isinstance(value, collections.abc.Mapping) else None


def features_of(value, where):
    """The GeoJSON features of one object."""
    kind = value.get("type")
    if kind == "FeatureCollection":
        return list(value.get("features", ()))
    if kind == "Feature":
        return [value]
    if kind in ("Polygon", "MultiPolygon", "LinearRing", "LineString", "MultiLineString", "GeometryCollection"):
        if kind == "LinearRing":
            value = {**value, "type": "LineString"}  # closed; GeoJSON has no type of its own for it
        return [{"type": "Feature", "properties": {}, "geometry": value}]
    raise ConfigError([f"{where}: expected polygons or closed lines, found GeoJSON of the type {kind}"])


def is_one_ring(rings):
    """True if rings is a ring [k,2] itself, and not a list of rings."""
    try:
        return np.ndim(rings) == 2 or np.ndim(next(iter(rings))) == 1
    except (TypeError, ValueError, StopIteration):
        return False


def rings_file(rings, where):
    """Ending and text of a file with rings. rings: one ring [k,2] or a list of them, for which holes follow from
    nesting; or one polygon or a list of them, with the properties of their features."""
    if isinstance(rings, collections.abc.Iterator):
        rings = list(rings)
    if geo_interface(rings) is not None:
        rings = [rings]
    elif is_one_ring(rings):
        return "xy", points_text(rings, where)
    if not isinstance(rings, collections.abc.Iterable) or isinstance(rings, (str, bytes)):
        raise ConfigError([f"{where}: expected rings as arrays [k,2], or polygons, found an object of type "
                           f"{type(rings).__name__}"])
    rings = list(rings)
    found = [geo_interface(ring) for ring in rings]
    if any(one is not None for one in found):
        if any(one is None for one in found):
            raise ConfigError([f"{where}: expected either arrays or polygons, found both"])
        features = [feature for one in found for feature in features_of(one, where)]
        return "geojson", json.dumps({"type": "FeatureCollection", "features": features}, default=float)
    if not rings:
        raise ConfigError([f"{where}: expected a ring or more, found none"])
    return "xy", "\n".join(xy_text(coordinates(ring, f"{where}[{k}]")) for k, ring in enumerate(rings))
