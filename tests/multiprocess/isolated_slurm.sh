#!/bin/sh
# usage: isolated_slurm.sh COMMAND...
# isolated.sh for tests that start Slurm: its daemons want a user who exists and is not root of a namespace (they set
# groups, which is forbidden there), and a network with an address other than loopback (they resolve names for
# configured families only).
here=$(dirname "$0")
if unshare -rn --pid --fork --mount-proc true 2>/dev/null; then
  exec "$here/isolated.sh" sh -c '
    ip link add cable0 type veth peer name cable1 && ip addr add 10.77.2.1/24 dev cable0 && ip link set cable0 up &&
      ip link set cable1 up || exit 2
    exec unshare --user --map-user=65534 --map-group=65534 "$@"' sh "$@"
fi
exec "$here/isolated.sh" "$@"
