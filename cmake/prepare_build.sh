# Sourced by ./demo and ./test from the top of the project: installs what is missing, then configures the release
# preset. Everything it says goes to stderr.

say() { printf '%s\n' "$*" >&2; }
die() { say "error: $*"; exit 1; }

# install_missing_packages [PACKAGE...]: all but these.
install_missing_packages() {
  command -v dpkg-query >/dev/null || {
    say "This is not a Debian system: nothing is installed. cmake/debian_packages.txt lists what the build needs."
    return
  }
  local missing=() name purpose
  while read -r name purpose; do
    [[ -z $name || $name == \#* || " $* " == *" $name "* ]] && continue
    # Node.js may come from elsewhere, with an npm of its own.
    [[ $name == nodejs || $name == npm ]] && command -v node npm >/dev/null && continue
    if [[ $(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null) != installed ]]; then
      [[ ${#missing[@]} -eq 0 ]] && say "Missing Debian packages:"
      say "  $(printf '%-20s %s' "$name" "$purpose")"
      missing+=("$name")
    fi
  done < cmake/debian_packages.txt
  [[ ${#missing[@]} -eq 0 ]] && return

  local as_root=()
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null ||
      die "installing them needs root and there is no sudo. As root, run: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  say "Installing them with apt-get${as_root:+ (through sudo)} ..."
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update -q &&
         "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
       } >"$log" 2>&1; then
    grep -E '^(E|W|Err):? ?' "$log" | head -n 12 >&2 || true
    rm -f "$log"
    die "apt-get failed (its complaints are above). Is the network there, and does /etc/apt/sources.list name a mirror of
Debian 12? When that is settled, run this again, or as root: apt-get install ${missing[*]}"
  fi
  rm -f "$log"
}

# What the page of `unsnarl view` is built with, as viewer/package-lock.json has it. The build itself needs no network,
# and without these the program is built without the page.
install_viewer_packages() {
  if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    say "There is no Node.js with npm: the program is built without 'unsnarl view'."
    return
  fi
  [[ viewer/node_modules/.package-lock.json -nt viewer/package-lock.json ]] && return
  say "Fetching what the page of 'unsnarl view' is built with (npm ci in viewer/) ..."
  local log
  log=$(mktemp)
  if ! (cd viewer && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error) >"$log" 2>&1; then
    head -n 5 "$log" >&2
    rm -rf viewer/node_modules
    say "npm failed (its words are above): the program is built without 'unsnarl view'. Run this again to try once more."
  fi
  rm -f "$log"
}

configure_release() {
  local log
  log=$(mktemp)
  if ! cmake --preset release "$@" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    die "CMake could not configure the build (its words are above). A build directory from another machine or
compiler is the usual cause: remove build/release and try again."
  fi
  rm -f "$log"
}
