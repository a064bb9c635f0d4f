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
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" >&2
  rm -f "$root"/build/*/.options  # what was configured without them may find them now
}

# configure_preset <preset> <cmake options...>: once, and again when the options changed (ninja itself notices changed
# CMake files). Options stay in the build folder until another value is given.
configure_preset() {
  local preset=$1 build=$root/build/$1
  shift
  [ -f "$build/build.ninja" ] && [ "$(cat "$build/.options" 2>/dev/null)" = "$*" ] && return 0
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
