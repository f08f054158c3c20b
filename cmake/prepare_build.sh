# Sourced by ./demo and ./test from the top of the project: installs what is missing, then configures the release
# preset. Everything it says goes to stderr.

say() { printf '%s\n' "$*" >&2; }
die() { say "error: $*"; exit 1; }

heartbeat_s=30  # nothing is silent for longer

# show_lines LOG: keeps what comes in the log; shows the last line on a terminal, elsewhere a line for each tenth of what
# is counted as [n/m]. Where nothing new comes it says from time to time what is going on, and for how long.
show_lines() {
  local line='' part='' latest=waiting last=-1 share start=$SECONDS said=$SECONDS code
  while true; do
    code=0
    IFS= read -r -t 5 part || code=$?
    line+=$part
    if ((code > 128)); then  # not all of a line yet
      tell_time
      continue
    fi
    [[ $code -ne 0 && -z $line ]] && break
    printf '%s\n' "$line" >>"$1"
    latest=$line
    line=
    if [[ -t 2 ]]; then
      printf '\r\033[K%.*s' "$((${COLUMNS:-80} - 1))" "$latest" >&2
    elif [[ $latest =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      share=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      if ((share > last)); then
        say "  $latest"
        last=$share said=$SECONDS
      fi
    fi
    tell_time
    [[ $code -ne 0 ]] && break
  done
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}

# Of show_lines, whose variables it uses.
tell_time() {
  if [[ -t 2 ]]; then
    printf '\r\033[K%ds %.*s' "$((SECONDS - start))" "$((${COLUMNS:-80} - 8))" "$latest" >&2
  elif ((SECONDS - said >= heartbeat_s)); then
    say "  $latest ($((SECONDS - start)) s so far)"
    said=$SECONDS
  fi
}

# count_packages TOTAL: counts what apt-get does with each: fetches, unpacks, sets up.
count_packages() {
  awk -v total="$((3 * $1))" '/^(Get:|Unpacking |Setting up )/ { if (n < total) ++n; $0 = "[" n "/" total "] " $0 }
                              { print; fflush() }'
}

is_root() { [[ $EUID -eq 0 ]]; }

# install_missing_packages all|build: what ./test needs, or what building and running the program needs.
install_missing_packages() {
  command -v dpkg-query >/dev/null || {
    say "This is not a Debian system: nothing is installed. cmake/debian_packages.txt lists what the build needs."
    return
  }
  local missing=() name purpose
  while read -r name purpose; do
    [[ $name == \# && $purpose == "Only ./test"* && $1 == build ]] && break
    [[ $name == \# && $purpose == "Only those"* ]] && break
    [[ -z $name || $name == \#* ]] && continue
    if [[ $(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null) != installed ]]; then
      [[ ${#missing[@]} -eq 0 ]] && say "Missing Debian packages:"
      say "  $(printf '%-20s %s' "$name" "$purpose")"
      missing+=("$name")
    fi
  done < cmake/debian_packages.txt
  [[ ${#missing[@]} -eq 0 ]] && return

  local as_root=() advice="As root, run: apt-get update && apt-get install --no-install-recommends ${missing[*]}
Then run this again."
  if ! is_root; then
    command -v sudo >/dev/null || die "installing them needs root, and there is no sudo. $advice"
    say "Installing them needs root: asking sudo ..."
    sudo true || die "sudo refused: this user may not install packages here. $advice"
    as_root=(sudo)
  fi
  say "Installing them with apt-get ..."
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
