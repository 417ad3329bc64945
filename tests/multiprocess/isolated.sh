#!/bin/sh
# usage: isolated.sh COMMAND...
# Runs COMMAND in a network of its own, so that tests which run at the same time never receive each other's messages,
# and in a process tree of its own, so that nothing it starts outlives it. Needs no root. Where user namespaces are
# forbidden, the test gets a port of its own instead (LCM 1.3.1 does not separate groups on one port) and NACRE_ISOLATED
# is 0.
if unshare -rn --pid --fork --mount-proc true 2>/dev/null; then
  export NACRE_ISOLATED=1 NACRE_TEST_PORT="${NACRE_TEST_PORT:-7667}"
  exec unshare -rn --pid --fork --kill-child --mount-proc sh -c '
    ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo || exit 2
    exec "$@"' sh "$@"
fi
export NACRE_ISOLATED=0 NACRE_TEST_PORT="${NACRE_TEST_PORT:-$((20000 + $$ % 40000))}"
exec "$@"
