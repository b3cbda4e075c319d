#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A SLURM of one node on this machine, to try the job scripts where no cluster is at hand. Needs root and the Debian
# packages munge slurmctld slurmd slurm-client. Everything lies in one directory; nothing in /etc is touched.
#   scripts/slurm_here.sh start [DIR]     then:  export SLURM_CONF=DIR/slurm.conf; sbatch jobs/single_node.sbatch
#   scripts/slurm_here.sh stop [DIR]      DIR: default /var/tmp/slurm_here
set -euo pipefail
dir=${2:-/var/tmp/slurm_here}
daemons=(slurmd slurmctld munged)

usage() { sed -n '5,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }

stop() {
  local daemon pid
  for daemon in "${daemons[@]}"; do
    [ -f "$dir/$daemon.pid" ] || continue
    pid=$(cat "$dir/$daemon.pid")
    # The number may have been given to somebody else since: only a process of that name is ended.
    if [ "$(sed 's/-wlm$//' "/proc/$pid/comm" 2>/dev/null || true)" = "$daemon" ]; then
      kill "$pid"
    fi
    rm -f "$dir/$daemon.pid"
  done
}

configure() {
  local cpus memory node
  cpus=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc) # nproc obeys these variables
  node=$(hostname -s)
  memory=$(awk '/^MemTotal/ {print int($2 / 1024 * 0.95)}' /proc/meminfo)
  mkdir -p "$dir/state" "$dir/spool"
  chmod 755 "$dir"
  [ -f "$dir/munge.key" ] || (umask 077 && head -c 128 /dev/urandom >"$dir/munge.key")
  cat >"$dir/slurm.conf" <<CONF
ClusterName=here
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket,cred_expire=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
NodeName=$node NodeAddr=127.0.0.1 CPUs=$cpus RealMemory=$memory State=UNKNOWN
PartitionName=here Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONF
}

start() {
  local waited=0
  for daemon in "${daemons[@]}"; do
    command -v "$daemon" >/dev/null || {
      echo "Missing $daemon; as root: apt-get install -y --no-install-recommends munge slurmctld slurmd slurm-client" >&2
      exit 1
    }
  done
  configure
  export SLURM_CONF="$dir/slurm.conf"
  munged --force --socket="$dir/munge.socket" --key-file="$dir/munge.key" --pid-file="$dir/munged.pid" \
    --log-file="$dir/munged.log" --seed-file="$dir/munge.seed"
  slurmctld
  slurmd
  until sinfo -h -o %T 2>/dev/null | grep -q idle; do
    waited=$((waited + 1))
    [ "$waited" -le 30 ] || { echo "SLURM did not come up within 30 s; see the logs in $dir" >&2; exit 1; }
    sleep 1
  done
  sinfo
  echo "export SLURM_CONF=$dir/slurm.conf"
}

case "${1:-}" in
  start) start ;;
  stop) stop ;;
  *) usage ;;
esac
