# SPDX-License-Identifier: BSD-3-Clause
"""A Python program that mpirun or srun starts, for python_in_jobs_test.py and jobs_test.py. Each of its ranks makes a
mesh, and reads it.

    mpirun -n 2 /usr/bin/python3 mesh_in_a_job.py DIRECTORY RANKS [mpi4py] [wrong=RANK]...

RANKS is the number of ranks of each run of trime_mpi. With `mpi4py` the program imports it first, and its ranks
communicate at the end. With `wrong=RANK` this rank uses a config with an unknown key. Each rank writes its results to
RANK.json in DIRECTORY.
"""
import json
import os
import pathlib
import sys

from trime_run import ROOT

if "mpi4py" in sys.argv:
    from mpi4py import MPI
sys.path.insert(0, str(ROOT / "scripts" / "python"))
import trime_mpi  # noqa: E402  (found by the line above)

DISC = {"shape": {"geometry": "disc", "disc": {"type": "circle", "center": (0.5, 0.5), "radius": 0.4}},
        "meshing": {"points": 700}}


def main():
    directory, ranks = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    names = ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID")  # of mpirun, mpiexec, srun
    rank = int(next((os.environ[name] for name in names if name in os.environ), 0))
    config = DISC | ({"sizing": {"gradaton": 0.1}} if f"wrong={rank}" in sys.argv else {})
    found = {}
    try:
        made = trime_mpi.mesh(config, ranks=ranks, threads=1, output=directory / f"{rank}.h5")
        found = {"hash": made.hash, "ranks": len(made.first_point)}
        found["read"] = trime_mpi.read(directory / f"{rank}.h5", in_place=True).hash
    except trime_mpi.TrimeError as error:
        found |= {"error": type(error).__name__, "message": str(error)}
    if "mpi4py" in sys.argv:
        found["size"] = len(MPI.COMM_WORLD.allgather(found))  # waits for all
    (directory / f"{rank}.json").write_text(json.dumps(found), encoding="utf-8")


if __name__ == "__main__":
    main()
