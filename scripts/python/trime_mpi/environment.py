# SPDX-License-Identifier: BSD-3-Clause
"""Makes the environment for a run of the program, also in a Python program that mpirun or srun has started.

They give the processes of their job variables that name this job. If a second MPI program finds them, it takes itself
for a process of that job, and fails. Some variables of mpirun begin with OMPI_MCA_, like the settings of users, which
the program must get. Therefore this module knows the whole names of the variables that mpirun sets.
"""
import os
import re

# Names that launchers set: Open MPI with ORTE (up to version 4) or PRRTE (from version 5), PMIx, MPICH, SLURM. The
# program writes SLURM_JOB_ID into the mesh file.
LAUNCHER = re.compile(r"(OMPI|PMIX|PRTE|PMI|HYDI)_|MPI_LOCAL(NRANKS|RANKID)$|SLURM_(?!JOB_ID$)")
# Names that users set for Open MPI, PRRTE and PMIx.
SETTING = re.compile(r"(OMPI|PRTE|PMIX)_MCA_|(OMPI|PRTE)_ALLOW_")
# Names of this kind that Open MPI's launcher sets.
OF_A_JOB = re.compile(
    r"(OMPI|PRTE)_MCA_(ess|ess_base_(jobid|num_procs|vpid)|initial_wdir|mpi_oversubscribe"
    r"|shmem_RUNTIME_QUERY_hint|(orte|prte)_(app_num"
    r"|base_applied_binding|bound_at_launch|cpu_model|cpu_type|do_not_barrier|ess_\w+|externally_bound|hnp_uri"
    r"|jobfam_session_dir|launch|local_daemon_uri|num_nodes|num_restarts|parent_uri|precondition_transports"
    r"|top_session_dir))$")
PMIX_OF_A_JOB = "^s1,s2,"  # Open MPI's launcher sets OMPI_MCA_pmix to a value that begins so
# Names that place the processes of a job; --map-by, --bind-to and other options of the launcher set them.
PLACES_OF_A_JOB = re.compile(r"OMPI_MCA_(rmaps_(?!base_oversubscribe$)|hwloc_base_(binding|cpu|report|slot|use))")


def is_inside_a_job(variables):
    """True if mpirun, mpiexec or srun has started this process, and not if a batch script has. variables: the
    environment of the process."""
    return any(name in variables for name in ("OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "SLURM_STEP_ID"))


def is_of_the_job(name, value):
    """True for a variable that the launcher has set, and that describes only its job."""
    if not LAUNCHER.match(name):
        return False
    if not SETTING.match(name):
        return True
    return bool(OF_A_JOB.match(name) or PLACES_OF_A_JOB.match(name)
                or (name == "OMPI_MCA_pmix" and value.startswith(PMIX_OF_A_JOB)))


def run_environment(variables=None):
    """Returns the environment for a run of the program, which is a separate job with any number of ranks.

    variables is the environment of the caller (default: os.environ). The run gets all settings of the user. Inside of a
    job it does not get the placement of the job's processes, and uses only this machine. There the ranks and threads of
    the run also yield their cores while they wait, since the processes of the outer job use the same cores.
    """
    variables = dict(os.environ if variables is None else variables)
    inside = is_inside_a_job(variables)
    if inside:
        variables = {name: value for name, value in variables.items() if not is_of_the_job(name, value)}
        variables.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")
        variables.setdefault("OMP_WAIT_POLICY", "passive")
    variables.setdefault("OMPI_MCA_hwloc_base_binding_policy", "none")
    variables.setdefault("OMPI_MCA_rmaps_base_oversubscribe", "1")
    variables.setdefault("OMPI_MCA_orte_execute_quiet", "1")
    if os.geteuid() == 0:  # containers
        variables |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return variables
