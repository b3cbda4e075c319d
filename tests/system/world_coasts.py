# SPDX-License-Identifier: BSD-3-Clause
"""Reads coasts of full resolution from the database GSHHG of Wessel and Smith (1996), which Debian's package
gmt-gshhg-full holds. The file has the coasts cut into segments by bins of one degree.
"""
import collections
import pathlib

import h5py
import numpy

DATABASE = pathlib.Path("/usr/share/gmt-gshhg/binned_GSHHS_f.nc")
# West, south, east and north of a box; only islands that lie inside of it completely are read.
REGIONS = {"faroes": (-8, 61.2, -6, 62.6), "balearics": (1, 38.5, 4.5, 40.2), "canaries": (-18.3, 27.5, -13.3, 29.5),
           "crete": (23.2, 34.7, 26.5, 35.8), "jamaica": (-78.6, 17.5, -76, 18.7), "shetland": (-2.3, 59.7, -0.5, 61),
           "hawaii": (-161, 18.5, -154.5, 22.5), "galapagos": (-92, -1.6, -89, 0.8)}
UNITS = 65535  # to the degree


class Database:
    """The segments of all coasts, in the order of the file."""

    def __init__(self, path=DATABASE):
        with h5py.File(path, "r") as file:
            def column(name):
                return file[name][:].astype(numpy.int64)
            words = column("Embedded_npts_levels_exit_entry_for_a_segment")
            self.count, self.level = words >> 9, (words >> 6) & 7
            self.polygon = column("Id_of_GSHHS_ID")
            self.first_point = column("Id_of_first_point_in_a_segment")
            self.first_segment, self.segments = column("Id_of_first_segment_in_a_bin"), column("N_segments_in_a_bin")
            self.x = column("Relative_longitude_from_SW_corner_of_bin") % (UNITS + 1)
            self.y = column("Relative_latitude_from_SW_corner_of_bin") % (UNITS + 1)

    def segments_by_polygon(self, west, south, east, north):
        """Chains of points of the shores of seas, in units of the file."""
        found = collections.defaultdict(list)
        for row in range(180):
            for column in range(360):
                lon, lat = column if column < 180 else column - 360, 89 - row
                if not (west - 1 <= lon <= east and south - 1 <= lat <= north):
                    continue
                first = self.first_segment[360 * row + column]
                for segment in range(first, first + self.segments[360 * row + column]):
                    if self.level[segment] == 1:
                        points = slice(self.first_point[segment], self.first_point[segment] + self.count[segment])
                        found[self.polygon[segment]].append(
                            list(zip(self.x[points] + lon * UNITS, self.y[points] + lat * UNITS)))
        return found

    def islands(self, west, south, east, north):
        """Closed rings [k,2] in degrees, those with most vertices first."""
        rings = []
        for chains in self.segments_by_polygon(west, south, east, north).values():
            rings += closed_rings(chains)
        rings = [numpy.array(ring) / UNITS for ring in rings if len(ring) >= 4]
        inside = [ring for ring in rings if (ring > [west, south]).all() and (ring < [east, north]).all()]
        return sorted(inside, key=len, reverse=True)


def closed_rings(chains):
    """Rings of chains that follow each other. Chains that lead out of the box are left out."""
    by_start = {chain[0]: chain for chain in chains}
    rings = []
    while by_start:
        start, chain = by_start.popitem()
        ring = chain[:-1]
        while chain[-1] != start and chain[-1] in by_start:
            chain = by_start.pop(chain[-1])
            ring += chain[:-1]
        if chain[-1] == start:
            rings.append(ring)
    return rings


def in_the_plane(rings, south, north):
    """Degrees of longitude are shortened as in the middle of the box."""
    return [ring * [numpy.cos(numpy.radians(0.5 * (south + north))), 1] for ring in rings]
