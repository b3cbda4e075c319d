#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A cluster of N hosts on this machine, to try a program over TCP where no cluster is at hand: network namespaces on a
# bridge. Open MPI starts one rank on each host in turn, and ranks share no memory, not even on one host.
#   scripts/hosts_here.sh N COMMAND...    e.g.  scripts/hosts_here.sh 4 mpirun -np 4 build/release/trime_mpi my.ini
# COMMAND runs on host1; `bash` gives a shell there. At its end each host's traffic is printed, and the hosts are gone.
# Exit code: that of COMMAND, or 77 where namespaces may not be made. Needs iproute2, and root or the right to make user
# namespaces.
set -euo pipefail
self=$(readlink -f "${BASH_SOURCE[0]}")
most=250         # hosts: one byte of the address
network=10.213.0 # theirs alone: no other network is seen from them, nor they from others
# Where names and addresses of the hosts lie, in a file system that nobody outside sees. Mounts and processes of the
# namespaces end with their first process, and that one with this script. So nothing is left, whatever ends it.
state=/run

usage() { sed -n '5,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }

fail() { echo "hosts_here.sh: $*" >&2; exit 77; }

# start N COMMAND...: runs `inside` as the first process of new namespaces.
start() {
  local world=(unshare --net --mount --pid --fork --kill-child --mount-proc) reason child
  [ "$(id -u)" -eq 0 ] || world+=(--user --map-root-user)
  for tool in unshare nsenter ip; do
    command -v "$tool" >/dev/null || fail "Missing $tool (Debian: util-linux, iproute2)"
  done
  reason=$("${world[@]}" ip link add type veth 2>&1) ||
    fail "No network namespaces with veth devices may be made here: $reason"
  setpriv --pdeathsig KILL "${world[@]}" "$self" inside "$@" <&0 &
  child=$!
  # unshare listens to no other signal; with it ends its child, and so all that this has started.
  trap 'kill -KILL "$child"' INT TERM
  wait "$child"
}

# on HOST COMMAND...: runs COMMAND on a host.
on() {
  local host=$1
  shift
  nsenter --net="$state/netns/$host" --uts="$state/$host.uts" -- "$@"
}

# add_host K: a host named hostK, by one cable on the bridge.
add_host() {
  local host=host$1
  ip netns add "$host"
  touch "$state/$host.uts"
  unshare --uts="$state/$host.uts" hostname "$host"
  ip link add "$host" type veth peer name eth0 netns "$host"
  ip link set "$host" master bridge up
  ip -n "$host" address add "$network.$1/24" dev eth0
  ip -n "$host" link set eth0 up
  ip -n "$host" link set lo up
  echo "$network.$1 $host" >>"$state/addresses"
  echo "$host" >>"$state/hosts"
}

# Tells Open MPI of the hosts, and how to reach them.
mpi_environment() {
  export OMPI_MCA_orte_default_hostfile="$state/hosts"
  export OMPI_MCA_plm_rsh_agent="$self enter"          # in place of ssh
  export OMPI_MCA_rmaps_base_mapping_policy=node       # a rank on each host in turn
  export OMPI_MCA_pml=ob1 OMPI_MCA_btl=tcp,self        # no shared memory
  export OMPI_MCA_btl_tcp_if_include=eth0 OMPI_MCA_oob_tcp_if_include=eth0
  export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
}

# inside N COMMAND...: makes the hosts, runs COMMAND on the first one, tells the traffic.
inside() {
  local hosts=$1 status=0 k
  shift
  mount -t tmpfs hosts_here "$state"
  mkdir "$state/netns"
  echo "127.0.0.1 localhost" >"$state/addresses"
  ip link add bridge type bridge
  ip link set bridge up
  for ((k = 1; k <= hosts; ++k)); do
    add_host "$k"
  done
  mount --bind "$state/addresses" /etc/hosts
  mpi_environment
  on host1 "$@" || status=$?
  for ((k = 1; k <= hosts; ++k)); do
    # This end of the cable: what the bridge receives is what the host has sent.
    ip -s link show dev "host$k" | awk -v host="host$k" '/ RX:/ { getline; sent = $1 } / TX:/ { getline; received = $1 }
      END { printf "%s: %s bytes sent, %s received\n", host, sent, received }' >&2
  done
  return "$status"
}

case "${1:-}" in
  inside) shift; inside "$@" ;;
  enter) shift; host=$1; shift; on "$host" sh -c "$*" ;; # as ssh: the words make one command line
  *)
    if ! [[ ${1:-} =~ ^[1-9][0-9]{0,2}$ ]] || [ "$1" -gt "$most" ] || [ "$#" -lt 2 ]; then
      usage
    fi
    start "$@" ;;
esac
