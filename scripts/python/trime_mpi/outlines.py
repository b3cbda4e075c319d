# SPDX-License-Identifier: BSD-3-Clause
"""Writes outlines and points as files that trime_mpi reads: arrays as .xy, polygons as .geojson."""
import collections.abc
import json

import numpy as np

from .errors import ConfigError


def coordinates(value, where):
    """Returns an array [k,2] of x and y, k > 0, from anything that NumPy can convert to it."""
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
    """Returns one line `x y` per point; floats keep all their bits."""
    return "".join(f"{x!r} {y!r}\n" for x, y in array.tolist())


def points_text(points, where):
    """Returns the text of an .xy file for points [k,2]."""
    return xy_text(coordinates(points, where))


def geo_interface(value):
    """Returns the GeoJSON dict of an object of shapely, geopandas or another library, or the value if it is a dict, or
    None."""
    value = getattr(value, "__geo_interface__", value)
    return value if isinstance(value, collections.abc.Mapping) else None


def features_of(value, where):
    """Returns the GeoJSON features of one GeoJSON dict."""
    kind = value.get("type")
    if kind == "FeatureCollection":
        return list(value.get("features", ()))
    if kind == "Feature":
        return [value]
    if kind in ("Polygon", "MultiPolygon", "LinearRing", "LineString", "MultiLineString", "GeometryCollection"):
        if kind == "LinearRing":
            value = {**value, "type": "LineString"}  # GeoJSON has no separate type for closed lines
        return [{"type": "Feature", "properties": {}, "geometry": value}]
    raise ConfigError([f"{where}: expected polygons or closed lines, found GeoJSON of the type {kind}"])


def is_one_ring(rings):
    """True if rings is one ring [k,2], and not a list of rings."""
    try:
        return np.ndim(rings) == 2 or np.ndim(next(iter(rings))) == 1
    except (TypeError, ValueError, StopIteration):
        return False


def rings_file(rings, where):
    """Returns the ending and the text of a file with rings.

    rings is one ring [k,2] or a list of rings, whose nesting decides what is a hole. It may also be one polygon or a
    list of polygons; properties of features are kept.
    """
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
