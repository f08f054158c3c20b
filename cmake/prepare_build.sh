# Sourced by ./demo and ./test from the top of the project: installs what is missing, then configures the release
# preset. Everything it says goes to stderr.

say() { printf '%s\n' "$*" >&2; }
die() { say "error: $*"; exit 1; }

# What is missing and why, to be said again at the end, where it is seen.
notes=()
note() { say "$*"; notes+=("$*"); }
say_notes() {
  local text
  for text in "${notes[@]}"; do say "note: $text"; done
}

# show_lines LOG: keeps what comes in the log; shows the last line on a terminal, elsewhere a line for each tenth of what
# is counted as [n/m].
show_lines() {
  local line share last=-1
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$1"
    if [[ -t 2 ]]; then
      printf '\r\033[K%.*s' "$((${COLUMNS:-80} - 1))" "$line" >&2
    elif [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      share=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      if ((share > last)); then
        say "  $line"
        last=$share
      fi
    fi
  done
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}

# count_packages TOTAL: counts what apt-get does with each: fetches, unpacks, sets up.
count_packages() {
  awk -v total="$((3 * $1))" '/^(Get:|Unpacking |Setting up )/ { if (n < total) ++n; $0 = "[" n "/" total "] " $0 }
                              { print; fflush() }'
}

# install_missing_packages all|build: what ./test needs, or what building and running the program needs.
install_missing_packages() {
  command -v dpkg-query >/dev/null || {
    say "This is not a Debian system: nothing is installed. cmake/debian_packages.txt lists what the build needs."
    return
  }
  local missing=() optional=() name purpose
  while read -r name purpose; do
    [[ $name == \# && $purpose == Only* && $1 == build ]] && break
    [[ -z $name || $name == \#* ]] && continue
    # Node.js may come from elsewhere, with an npm of its own.
    [[ $name == nodejs || $name == npm ]] && command -v node npm >/dev/null && continue
    if [[ $(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null) != installed ]]; then
      [[ ${#missing[@]} -eq 0 ]] && say "Missing Debian packages:"
      say "  $(printf '%-20s %s' "$name" "$purpose")"
      missing+=("$name")
      [[ $name == nodejs || $name == npm ]] && optional+=("$name")
    fi
  done < cmake/debian_packages.txt
  [[ ${#missing[@]} -eq 0 ]] && return

  local as_root=()
  if [[ $EUID -ne 0 ]]; then
    if ! command -v sudo >/dev/null; then
      local advice="As root, run: apt-get update && apt-get install --no-install-recommends ${missing[*]}"
      [[ ${#missing[@]} -gt ${#optional[@]} ]] && die "installing them needs root and there is no sudo. $advice"
      note "The program is built without 'unsnarl view', for which ${optional[*]} is missing. $advice"
      return
    fi
    as_root=(sudo)
  fi
  say "Installing them with apt-get${as_root:+ (through sudo)} ..."
  local log total
  log=$(mktemp)
  if ! "${as_root[@]}" apt-get update -q 2>&1 | show_lines "$log"; then packages_failed "$log" "${missing[*]}"; fi
  total=$(apt-get install -s --no-install-recommends "${missing[@]}" 2>/dev/null | grep -c '^Inst' || true)
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" \
    2>&1 | count_packages "$total" | show_lines "$log"; then
    packages_failed "$log" "${missing[*]}"
  fi
  rm -f "$log"
}

packages_failed() {
  grep -E '^(E|W|Err):? ?' "$1" | head -n 12 >&2 || true
  rm -f "$1"
  die "apt-get failed (its complaints are above). Is the network there, and does /etc/apt/sources.list name a mirror of
Debian 12? When that is settled, run this again, or as root: apt-get update && apt-get install $2"
}

# What the page of `unsnarl view` is built with, as viewer/package-lock.json has it. The build itself needs no network,
# and without these the program is built without the page.
install_viewer_packages() {
  if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    note "There is no Node.js with npm: the program is built without the page of 'unsnarl view'."
    return
  fi
  [[ viewer/node_modules/.package-lock.json -nt viewer/package-lock.json ]] && return
  say "Fetching what the page of 'unsnarl view' is built with (npm ci in viewer/) ..."
  local log
  log=$(mktemp)
  if ! (cd viewer && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error) >"$log" 2>&1; then
    head -n 5 "$log" >&2
    rm -rf viewer/node_modules
    note "npm failed ($(head -n 1 "$log")): the program is built without the page of 'unsnarl view'. Run this again to
try once more."
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
