# SPDX-License-Identifier: BSD-3-Clause
"""The ways to run a case: under mpirun on this machine, through SLURM, or on a simulated cluster."""
from . import slurm
from .local import Local
from .simulated import Simulated

NAMES = (Local.name, slurm.NAME, Simulated.name)


def make_backend(name, program, cluster=None):
    """The backend of that name that runs cases one by one, local or simulated. Raises UsageError where it cannot."""
    return Simulated(cluster) if name == Simulated.name else Local(program)
