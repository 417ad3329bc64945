# Shared by launch/game and tests/run: installs what is missing and builds. Source it with NACRE_ROOT set.

say() { printf '%s\n' "nacre: $*" >&2; }
give_up() { say "$*"; exit 2; }

# may_install MISSING: gives up with a sentence when this user cannot install packages.
may_install() {
  [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null ||
    give_up "installing packages needs root: run this as root, or install sudo, or have somebody type: apt-get install $1"
}

# as_root COMMAND...: runs it as root, through sudo when needed.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# wanted_packages game|tests: names from packages.txt.
wanted_packages() {
  sed -e 's/#.*//' -e 's/[[:space:]]//g' "$NACRE_ROOT/launch/packages.txt" |
    awk -v all="$1" '/^tests:$/ { if (all != "tests") exit; next } NF'
}

missing_packages() {
  local package
  for package in $(wanted_packages "$1"); do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || printf '%s ' "$package"
  done
}

# install_packages game|tests
install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    give_up "this script installs Debian packages; on another system install the equivalents of launch/packages.txt and run: cmake --preset release && cmake --build build"
  local missing log
  missing=$(missing_packages "$1")
  [ -n "$missing" ] || { say "packages: all installed"; return; }
  may_install "$missing"   # before anything goes to the log, where nobody would see it
  log=$(mktemp -t nacre-apt.XXXXXX)
  say "packages: installing $(wc -w <<<"$missing") ($missing)"
  as_root apt-get update -q >"$log" 2>&1 || give_up "apt-get update failed (see $log): is the network up?"
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing 2>&1 |
    tee -a "$log" | awk '/^(Setting up|Selecting) / { count++; if (count % 20 == 0) { print "nacre:   " count " steps, at " ($1 == "Setting" ? $3 : $NF) > "/dev/stderr" } }' || true
  missing=$(missing_packages "$1")
  [ -z "$missing" ] || give_up "these packages could not be installed: $missing(see $log)"
  rm -f "$log"
}

# build: configures and builds everything in build/.
build() {
  local log="$NACRE_ROOT/build/setup.log"
  mkdir -p "$NACRE_ROOT/build"
  say "configuring (Release, build/)"
  (cd "$NACRE_ROOT" && cmake --preset release) >"$log" 2>&1 || { tail -n 20 "$log" >&2; give_up "configuring failed; the whole output is in build/setup.log"; }
  say "building with $(nproc) cores"
  if [ -t 2 ]; then
    cmake --build "$NACRE_ROOT/build" >&2 || give_up "building failed"
    return
  fi
  # Not a terminal: one plain line every 40 steps; compiler messages go to the log and are shown when something fails.
  if ! cmake --build "$NACRE_ROOT/build" 2>&1 | tee -a "$log" |
    awk '/^\[[0-9]+\/[0-9]+\]/ { split(substr($1, 2), n, /[\/\]]/); if (n[1] % 40 == 0 || n[1] == n[2]) print "nacre:   step " n[1] " of " n[2] > "/dev/stderr" }'; then
    grep -m 20 -E 'error|FAILED' "$log" >&2 || true
    give_up "building failed; the whole output is in build/setup.log"
  fi
}
