# SPDX-License-Identifier: BSD-3-Clause
"""Draws triangles as pixels with NumPy, for meshes with too many triangles to draw them one by one.

Each triangle gives its value to sample points whose distance is less than a pixel, and each pixel gets the mean of its
samples. A triangle that is smaller than a pixel has one sample, so the cost grows with the numbers of triangles and of
pixels. Triangles that cover many pixels are drawn as polygons: there cannot be many of them.
"""
import numpy as np

CHUNK = 1 << 18     # rows at a time: their temporary arrays are used again, larger ones come from the system each time
LARGEST_LEVEL = 3   # triangles of more than 2^3 pixels become polygons
LONGEST_EDGE = 1.5  # [h] of nearly all triangles


def slices(count):
    """Returns slices that cover this number of rows, CHUNK rows each."""
    return (slice(first, min(first + CHUNK, count)) for first in range(0, count, CHUNK))


class Canvas:
    """Square pixels over a box of coordinates. shape: the numbers of rows and columns; row 0 is the lowest."""

    def __init__(self, low, high, pixels):
        self.low, self.high = np.asarray(low, float), np.asarray(high, float)
        span = np.maximum(self.high - self.low, 1e-300)
        self.side = span.max() / pixels
        columns, rows = np.maximum(np.ceil(span / self.side - 1e-9).astype(int), 1)
        self.shape = int(rows), int(columns)
        self.extent = (self.low[0], self.low[0] + columns * self.side, self.low[1], self.low[1] + rows * self.side)

    def pixels_of_points(self, places):
        """Returns the same for places [N,2]."""
        found = np.empty(len(places), np.int32)
        for rows in slices(len(places)):
            found[rows] = self.pixels_of(places[rows, 0], places[rows, 1])
        return found

    def pixels_of(self, x, y):
        """Returns the flat indices of the pixels that hold points. Points beyond the box count for its rim."""
        column = np.clip(((x - self.low[0]) * (1 / self.side)).astype(np.int32), 0, self.shape[1] - 1)
        row = np.clip(((y - self.low[1]) * (1 / self.side)).astype(np.int32), 0, self.shape[0] - 1)
        return row * np.int32(self.shape[1]) + column


def sample_weights(level):
    """Returns the barycentric coordinates of the centres of the 4^level triangles into which a triangle is divided."""
    weights = [np.full(3, 1 / 3)]
    for _ in range(level):
        corners = np.eye(3)
        weights = [(w + corner) / 2 for w in weights for corner in corners] + [np.full(3, 0.5) - w / 2 for w in weights]
    return weights


def levels_of(x, y, side):
    """Returns how often triangles (corners [3, k]) must be divided into four, so that their samples lie closer than
    pixels."""
    extent = np.maximum(*(np.maximum(np.maximum(abs(axis[1] - axis[0]), abs(axis[2] - axis[0])),
                                     abs(axis[2] - axis[1])) for axis in (x, y)))
    level = np.zeros(len(extent), np.int8)
    large = extent > side
    level[large] = np.minimum(np.ceil(np.log2(extent[large] / side)), LARGEST_LEVEL + 1)
    return level


def corners_of(mesh, rows):
    """Returns x and y [3, k] of the corners of some triangles. In a periodic container they lie next to each other."""
    place = mesh.points[mesh.triangles[rows].T]
    both = [place[:, :, 0], place[:, :, 1]]
    for axis, period in zip(both, mesh.periods):
        if period > 0:
            axis -= period * np.round((axis - axis[0]) / period)
    return both


def samples(mesh, canvas, polygons):
    """Yields (triangles, pixels of one sample of each). A triangle comes as often as it has samples. The numbers of
    triangles that are too large are appended to `polygons`.

    Where all triangles are smaller than a pixel, each is sampled at its first vertex. Triangles are sorted by it, which
    makes this several times faster.
    """
    at_points = canvas.pixels_of_points(mesh.points)
    for rows in slices(len(mesh.triangles)):
        first, vertices = rows.start, mesh.triangles[rows, 0]
        if LONGEST_EDGE * mesh.size[vertices].max() < canvas.side:
            yield rows, at_points[vertices]
            continue
        x, y = corners_of(mesh, rows)
        level = levels_of(x, y, canvas.side)
        for depth in np.unique(level):
            chosen = np.flatnonzero(level == depth)
            if depth > LARGEST_LEVEL:
                polygons.extend(first + chosen)
                continue
            for weight in sample_weights(int(depth)):
                yield first + chosen, canvas.pixels_of(weight @ x[:, chosen], weight @ y[:, chosen])


def mean_image(mesh, canvas, value):
    """Returns the mean of value [M] of the triangles in each pixel, NaN in empty pixels, and the triangles that must be
    drawn as polygons."""
    polygons = []
    count, total = np.zeros(canvas.shape[0] * canvas.shape[1]), np.zeros(canvas.shape[0] * canvas.shape[1])
    for triangles, pixels in samples(mesh, canvas, polygons):
        first = pixels.min()
        pixels = pixels - first  # triangles that follow each other lie together: few rows of pixels
        counted = np.bincount(pixels)
        count[first:first + len(counted)] += counted
        total[first:first + len(counted)] += np.bincount(pixels, weights=value[triangles])
    with np.errstate(invalid="ignore"):
        return (total / count).reshape(canvas.shape), np.array(polygons, int)


def number_image(mesh, canvas, number):
    """Returns number [M] of one of the triangles in each pixel, -1 in empty pixels, and the triangles that must be
    drawn as polygons."""
    polygons = []
    image = np.full(canvas.shape[0] * canvas.shape[1], -1, np.int64)
    for triangles, pixels in samples(mesh, canvas, polygons):
        image[pixels] = number[triangles]
    return image.reshape(canvas.shape), np.array(polygons, int)


def facet_mask(mesh, canvas, facets):
    """Returns True for the pixels through which facets pass that are shorter than a few pixels."""
    ends = mesh.facet_ends(facets)
    mask = np.zeros(canvas.shape[0] * canvas.shape[1], bool)
    for share in (0.0, 0.25, 0.5, 0.75):
        places = (1 - share) * ends[:, 0] + share * ends[:, 1]
        mask[canvas.pixels_of(places[:, 0], places[:, 1])] = True
    return mask.reshape(canvas.shape)
