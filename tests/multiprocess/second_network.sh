#!/bin/sh
# usage: second_network.sh PID
# Joins this network with that of process PID by a pair of virtual cables, as two machines on one switch would be:
# 10.77.0.1 here, 10.77.0.2 there. For networks of tests' own (isolated.sh); needs to be root in both. Prints
# "connected".
set -e
theirs=/proc/$1/ns/net
for turn in 1 2 3 4 5 6 7 8 9 10; do   # until the process has its own network
  [ "$(readlink "$theirs")" != "$(readlink /proc/self/ns/net)" ] && break
  sleep 0.2
done
if [ "$(readlink "$theirs")" = "$(readlink /proc/self/ns/net)" ]; then
  echo "process $1 has no network of its own"
  exit 1
fi
there() { nsenter --net="$theirs" "$@"; }

ip link add here type veth peer name there netns "$1"
ip addr add 10.77.0.1/24 dev here
ip link set here up
there ip addr add 10.77.0.2/24 dev there
there ip link set lo up
there ip link set there up

# This is all that nacre itself asks for on each machine: multicast leaves by the interface to the others.
ip route replace 224.0.0.0/4 dev here
there ip route replace 224.0.0.0/4 dev there
echo connected
