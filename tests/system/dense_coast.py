# SPDX-License-Identifier: BSD-3-Clause
"""Makes a coast with any number of vertices, on one ring that does not cross itself."""
import math
import random


def dense_coast(seed, ruggedness, vertices):
    """A closed curve around the origin: from level to level midpoints are displaced by a share of the way between."""
    rng = random.Random(seed)
    ring = [complex(math.cos(k * math.pi / 8), math.sin(k * math.pi / 8)) for k in range(16)]
    while len(ring) < vertices:
        ahead = ring[1:] + ring[:1]
        middles = [(a + b) / 2 + 1j * (b - a) * rng.uniform(-ruggedness, ruggedness) for a, b in zip(ring, ahead)]
        ring = [p for pair in zip(ring, middles) for p in pair]
    return ring


def text_of_coast(ring):
    """Its contour file."""
    return "".join(f"{p.real!r} {p.imag!r}\n" for p in ring)
