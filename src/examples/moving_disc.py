#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A disc moves through a channel, and each mesh starts from the one before.

    mpirun -n 2 python3 moving_disc.py [STEPS [POINTS]]
"""
import sys
import time

import numpy as np
from mpi4py import MPI
from trime_mpi import parallel

comm = MPI.COMM_WORLD
steps, points = (int(value) for value in (sys.argv[1:] + ["50", "20000"][len(sys.argv) - 1:]))
RADIUS, NEAR, FAR, GROWTH = 0.15, 1, 3, 10  # the size at the disc, far away, and its growth per length
unit = 0.0053 * np.sqrt(20000 / points)  # the size at the disc
channel = parallel.rectangle("channel", (0, 0), (4, 1))


def mesh_at(x, start=None):
    """Returns the mesh around the disc at x, and how long it took."""
    def size(p):
        away = np.sqrt((p[:, 0] - x)**2 + (p[:, 1] - 0.5)**2) - RADIUS
        return unit * np.minimum(FAR, NEAR + GROWTH * np.maximum(away, 0))

    begin = time.perf_counter()
    made = parallel.mesh(comm, channel - parallel.circle("disc", (x, 0.5), RADIUS), size=size, absolute_sizes=True,
                         start=start)
    return made, comm.allreduce(time.perf_counter() - begin, MPI.MAX)


mesh = None
for step in range(steps + 1):
    mesh, seconds = mesh_at(0.5 + step * unit, start=mesh)  # by one edge in a step
    if comm.rank == 0:
        print(f"step {step}: {mesh.total_points} points, {mesh.sweeps} sweeps, largest alpha "
              f"{mesh.quality['alpha_max']:.3f}, {seconds:.3f} s, hash {mesh.hash}", flush=True)
