# SPDX-License-Identifier: BSD-2-Clause
# Sourced by ./render, ./figures and ./check: installs what is missing, then configures and builds one preset.

# One compiler cache for every checkout of this project on the machine.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=time_macros

# say <text>: one line about what is being done, on standard error.
say() { printf '\033[1m==>\033[0m %s\n' "$*" >&2; }

# install_packages <render|figures|check>: Debian packages of scripts/packages.txt that are not there yet.
install_packages() {
  local purpose=$1 missing=() name note
  while read -r name note; do
    case $name in '' | '#'*) continue ;; esac
    case $purpose:$note in render:?* | figures:check) continue ;; esac
    dpkg-query -W -f='${Status}' "$name" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$name")
  done <"$root/scripts/packages.txt"
  [ ${#missing[@]} -eq 0 ] && return 0
  command -v apt-get >/dev/null || {
    echo "error: missing packages (${missing[*]}) and no apt-get here; install them and run again" >&2
    return 1
  }
  local sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "error: need root (or sudo) to install: ${missing[*]}" >&2
      return 1
    }
    sudo=(sudo)
  fi
  say "installing ${#missing[@]} packages: ${missing[*]}"
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q >&2
  # Ubuntu 22.04 lacks some that are optional (cmake says which parts are left out then).
  local known=() unknown=()
  for name in "${missing[@]}"; do
    if apt-cache show "$name" >/dev/null 2>&1; then known+=("$name"); else unknown+=("$name"); fi
  done
  [ ${#unknown[@]} -eq 0 ] || say "not in the package lists of this system, left out: ${unknown[*]}"
  [ ${#known[@]} -eq 0 ] && return 0
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${known[@]}" >&2
  rm -f "$root"/build/*/.options  # what was configured without them may find them now
}

# choose_compiler: GCC 12, which Ubuntu 22.04 has beside its own 11. A compiler that is asked for by CXX stays.
choose_compiler() {
  [ -z "${CXX:-}" ] && command -v g++ >/dev/null && [ "$(g++ -dumpversion | cut -d. -f1)" -lt 12 ] || return 0
  if ! command -v g++-12 >/dev/null && [ "$(id -u)" -eq 0 ]; then
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends g++-12 >&2
  fi
  command -v g++-12 >/dev/null || {
    echo "error: g++ is older than 12 here; install g++-12 (apt-get install g++-12) or set CXX" >&2
    return 1
  }
  export CC=gcc-12 CXX=g++-12
}

# configure_preset <preset> <cmake options...>: once, and again when the options changed (ninja itself notices changed
# CMake files). Options stay in the build folder until another value is given.
configure_preset() {
  local preset=$1 build=$root/build/$1
  shift
  [ -f "$build/build.ninja" ] && [ "$(cat "$build/.options" 2>/dev/null)" = "$*" ] && return 0
  choose_compiler
  say "configuring $preset"
  (cd "$root" && cmake --preset "$preset" "$@" >"$build.log" 2>&1) || {
    cat "$build.log" >&2
    return 1
  }
  printf '%s' "$*" >"$build/.options"
}

# build_targets <preset> <ninja targets...>: builds them, or everything.
build_targets() {
  local preset=$1
  shift
  say "building $preset"
  ninja -C "$root/build/$preset" -j "$(nproc)" "$@" >&2
}
