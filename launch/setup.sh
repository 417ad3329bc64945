# Shared by launch/game and tests/run: installs what is missing, builds, and bundles the dashboard's page. Source it
# with NACRE_ROOT set.
: "${NACRE_ROOT:?set NACRE_ROOT to the folder of the project before sourcing this}"

say() { printf '%s\n' "nacre: $*" >&2; }
give_up() { say "$*"; exit 2; }

# may_install MISSING: gives up with a sentence when this user cannot install packages.
may_install() {
  [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null ||
    give_up "installing packages needs root: run this as root, or install sudo, or have somebody type:" \
      "apt-get install $1"
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

# show_packages: of lines of apt-get that tell of a package, every 20th. Read by the shell, as in show_steps: Debian's
# awk waits for a full buffer.
show_packages() {
  local line count=0
  while IFS= read -r line; do
    [[ $line =~ ^(Setting up|Selecting previously unselected package)\ ([^ ]+) ]] || continue
    if ((++count % 20 == 0)); then say "  $count steps, at ${BASH_REMATCH[2]}"; fi
  done
}

# install_packages game|tests
install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    give_up "this script installs Debian packages; on another system install the equivalents of launch/packages.txt" \
      "and run: cmake --preset release && cmake --build build"
  local missing log
  missing=$(missing_packages "$1")
  [ -n "$missing" ] || { say "packages: all installed"; return; }
  may_install "$missing"   # before anything goes to the log, where nobody would see it
  log=$(mktemp -t nacre-apt.XXXXXX)
  say "packages: installing $(wc -w <<<"$missing") ($missing)"
  as_root apt-get update -q >"$log" 2>&1 || give_up "apt-get update failed (see $log): is the network up?"
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing 2>&1 |
    tee -a "$log" | show_packages || true
  missing=$(missing_packages "$1")
  [ -z "$missing" ] || give_up "these packages could not be installed: $missing(see $log)"
  rm -f "$log"
}

# show_steps: of lines that begin with [STEP/ALL], every 40th step and the last.
show_steps() {
  local line
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    if ((BASH_REMATCH[1] > 0 && BASH_REMATCH[1] % 40 == 0 || BASH_REMATCH[1] == BASH_REMATCH[2])); then
      say "  step ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]}"
    fi
  done
}

# build TARGET: configures, and builds a target (play: what plays; all: tests and studies too) in build/.
build() {
  local target=$1 log="$NACRE_ROOT/build/setup.log"
  mkdir -p "$NACRE_ROOT/build"
  say "configuring (Release, build/)"
  if ! (cd "$NACRE_ROOT" && cmake --preset release) >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    give_up "configuring failed; the whole output is in build/setup.log"
  fi
  say "building with $(nproc) cores"
  if [ -t 2 ]; then
    cmake --build "$NACRE_ROOT/build" --target "$target" >&2 || give_up "building failed"
    return
  fi
  # Not a terminal: one plain line every 40 steps; compiler messages go to the log and are shown when something fails.
  if ! cmake --build "$NACRE_ROOT/build" --target "$target" 2>&1 | tee -a "$log" | show_steps; then
    grep -m 20 -E 'error|FAILED' "$log" >&2 || true
    give_up "building failed; the whole output is in build/setup.log"
  fi
}

# has_npm: whether Node.js 18 or later and npm are there, whoever installed them.
has_npm() {
  command -v npm >/dev/null && [ "$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null || echo 0)" -ge 18 ]
}

# install_npm: Debian's nodejs and npm, where neither Debian nor anybody else has installed them. The C++ build needs
# neither.
install_npm() {
  has_npm && return 0
  { [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null; } || return 1
  say "packages: installing nodejs and npm for the dashboard's page (NACRE_PAGE=0 leaves it out)"
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends nodejs npm >/dev/null 2>&1 && has_npm
}

# build_page [required]: bundles web/ into build/web when its sources are newer. Without npm, or without a network,
# everything but `nacre dashboard` works all the same; `required` gives up then.
build_page() {
  [ "${NACRE_PAGE:-1}" != 0 ] || { say "page: left out"; return 0; }
  local web="$NACRE_ROOT/web" log="$NACRE_ROOT/build/page.log" page="$NACRE_ROOT/build/web/page.js"
  [ -f "$page" ] &&
    [ -z "$(find "$web" "$NACRE_ROOT/docs/GLOSSARY.md" -path "$web/node_modules" -prune -o -type f -newer "$page" \
      -print -quit)" ] &&
    { [ "${1:-}" != required ] || [ -d "$web/node_modules/playwright-core" ]; } && return 0
  mkdir -p "$NACRE_ROOT/build"
  say "page: bundling web/"
  if install_npm &&
    { [ "$web/node_modules/.package-lock.json" -nt "$web/package-lock.json" ] || npm --prefix "$web" ci; } \
      >"$log" 2>&1 &&
    npm --prefix "$web" run build >>"$log" 2>&1; then return 0; fi
  if [ "${1:-}" = required ]; then
    tail -n 20 "$log" >&2
    give_up "the page could not be built; the whole output is in build/page.log"
  fi
  say "page: not built (see build/page.log); everything but nacre dashboard works without it"
}
