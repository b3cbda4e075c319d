# SPDX-License-Identifier: BSD-3-Clause
# What all job scripts share; they source it, and it does nothing by itself. It sets
#   program   the trime_mpi to run: TRIME_PROGRAM, else the one built in this tree, else the installed one
#   threads   threads of each rank: --cpus-per-task of the job
# and has functions to take the config from the arguments, to start the program, and to make a scaling table.
# shellcheck shell=bash

# On most clusters MPI and HDF5 come as modules. Load the same ones that you built the program with, here, once for all
# scripts, or before sbatch (a job inherits the environment of the shell that submits it):
# module load gcc openmpi hdf5

job_fail() { echo "$*" >&2; exit 2; }

[ -n "${SLURM_JOB_ID:-}" ] || job_fail "This is a job script: expected a SLURM job, found none. Try: sbatch $0 $*"

program=${TRIME_PROGRAM:-build/release/trime_mpi}
if [ -z "${TRIME_PROGRAM:-}" ] && [ ! -x "$program" ] && command -v trime_mpi >/dev/null; then
  program=$(command -v trime_mpi)
fi
[ -x "$program" ] || [ -n "${TRIME_CONTAINER:-}" ] || job_fail "Expected the program at $program in $PWD, found nothing." \
  "Submit from the top of the source tree, after scripts/run.sh or cmake --workflow --preset release, or set TRIME_PROGRAM."

threads=${SLURM_CPUS_PER_TASK:-1}
export OMP_NUM_THREADS=$threads             # threads of each rank
export OMP_PLACES=cores                     # one core for each thread,
export OMP_PROC_BIND=close                  # the threads of a rank side by side
# Since SLURM 22.05 srun does not read --cpus-per-task from the job: without this, every rank would get one core.
export SRUN_CPUS_PER_TASK=$threads
if [ "$(id -u)" -eq 0 ]; then               # containers; never so on a cluster
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi

# job_config ARGUMENT...: sets config and overrides. The first argument is the config unless it is an override.
job_config() {
  config=${TRIME_CONFIG:-configs/square.ini}
  case "${1:-}" in
    '' | -* | *=*) ;;
    *) config=$1; shift ;;
  esac
  overrides=("$@")
  [ -r "$config" ] || job_fail "Expected a config file at $config in $PWD, found none that can be read." \
    "Give its path as the first argument."
}

# job_command CONFIG [section.key=value ...]: sets command_line, which starts the program on all ranks of the job.
# TRIME_LAUNCHER: mpirun (default), the mpiexec of another MPI, or srun, with options, e.g. "srun --mpi=pmix".
# TRIME_CONTAINER: what to put before the program, e.g. "apptainer exec trime_mpi.sif".
job_command() {
  local launch=() container=() kind
  read -ra launch <<<"${TRIME_LAUNCHER:-mpirun}"
  read -ra container <<<"${TRIME_CONTAINER:-}"
  # A block of as many cores for each rank as it has threads.
  kind=${launch[0]##*/}
  [ "$kind" = srun ] || kind=$("${launch[0]}" --version 2>&1 || true)
  case "$kind" in
    srun) launch+=(--ntasks="$SLURM_NTASKS" --cpu-bind=cores --kill-on-bad-exit=1) ;;
    *"Open MPI"* | *OpenRTE*)
      # Without PE= Open MPI binds a rank to one core when there are one or two ranks, and all its threads would share
      # that core. --report-bindings prints where each rank went.
      launch+=(-n "$SLURM_NTASKS" --map-by "slot:PE=$threads" --bind-to core --report-bindings) ;;
    *HYDRA*) launch+=(-n "$SLURM_NTASKS" -bind-to "core:$threads") ;; # of MPICH
    *) launch+=(-n "$SLURM_NTASKS") ;; # another one: its options, if any, stand in TRIME_LAUNCHER
  esac
  command_line=("${launch[@]}" ${container[@]+"${container[@]}"} "$program" "$@")
}

# job_run CONFIG [section.key=value ...]: runs that; returns its exit code.
job_run() {
  job_command "$@"
  "${command_line[@]}"
}

# job_restartable CONFIG [section.key=value ...]: runs that from the newest checkpoint, if there is one. The signal USR1
# to this script stops the program at a checkpoint, and the job is queued again. Returns the exit code of the program.
job_restartable() {
  local code=0 pid
  job_command "$@" --restart auto
  "${command_line[@]}" &
  pid=$!
  trap 'kill -USR1 "$pid" 2>/dev/null || true' USR1
  if [ -n "${asked_early:-}" ]; then # the launcher must be up before it can hand the signal on
    (sleep 5; kill -USR1 "$pid") &
  fi
  wait "$pid" || code=$?
  while [ "$code" -eq 138 ] && kill -0 "$pid" 2>/dev/null; do # USR1 ended `wait`, not the program
    code=0
    wait "$pid" || code=$?
  done
  if [ "$code" -eq 138 ]; then # the program ended meanwhile, or by USR1
    code=0
    wait "$pid" || code=$?
  fi
  [ "$code" -ne 75 ] || scontrol requeue "$SLURM_JOB_ID"
  return "$code"
}

# job_hello WHAT: the first lines of the log, so that a result can be traced.
job_hello() {
  echo "job $SLURM_JOB_ID on $SLURM_JOB_NODELIST: $SLURM_NTASKS ranks x $threads threads, $1"
  git describe --always --dirty 2>/dev/null || true
}

# job_scaling NAME KIND ARGUMENT...: the strong or weak sweeps of scripts/scaling.py on 1, 2, 4, ... cores of the job, as
# ranks, as threads and as both, into the directory NAME-JOBID.
job_scaling() {
  local name=$1 kind=$2
  shift 2
  [ -r scripts/scaling.py ] || job_fail "Expected scripts/scaling.py in $PWD, found none. Submit from the top of the source tree."
  job_hello "$kind scaling"
  "${PYTHON:-/usr/bin/python3}" scripts/scaling.py --program "$program" --kind "$kind" --cases powers \
    --output "$name-$SLURM_JOB_ID" "$@"
}
