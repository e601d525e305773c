#!/bin/sh
# The peers that the benchmarks can do without: brought where that is possible, else a line each says what is left out.
# usage: peers.sh BUILD_DIRECTORY. Debian's as root by apt, others by npm into the build directory.
# ISOSTEP_NO_INSTALL=1: nothing is brought.
# SPDX-License-Identifier: MIT
set -u
build=$1
node_peers='@dimforge/rapier3d-simd-compat@0.20.0 @dimforge/rapier3d-deterministic-compat@0.21.0
  @babylonjs/havok@1.3.14 jolt-physics@1.1.0 physx-js-webidl@2.7.3 @mujoco/mujoco@3.14.0'

say() { printf '%s\n' "$*" >&2; }
have() { command -v "$1" >/dev/null 2>&1; }
may_install() { [ "${ISOSTEP_NO_INSTALL:-}" != 1 ]; }

# is_there PACKAGE: what the Debian package brings, by whatever means.
is_there() {
  case $1 in
    pkg-config) have pkg-config ;;
    libbullet-dev) have pkg-config && pkg-config --exists bullet ;;
    libode-dev) have pkg-config && pkg-config --exists ode ;;
    gnuplot-nox) have gnuplot ;;
    nodejs) have node ;;
    npm) have npm ;;
  esac
}
missing() {
  for package in pkg-config libbullet-dev libode-dev gnuplot-nox nodejs npm; do
    is_there "$package" || printf '%s ' "$package"
  done
}

packages=$(missing)
if [ -n "$packages" ] && may_install && have apt-get && [ "$(id -u)" = 0 ]; then
  say "apt-get update && apt-get install -y --no-install-recommends $packages"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update >&2
  for package in $packages; do apt-get install -y --no-install-recommends "$package" >&2; done
  rm -f "$build/CMakeCache.txt" # so that CMake looks again
fi
for package in $(missing); do say "$package is not installed: what needs it is left out"; done
# 385 MB for one engine of the laboratory: whoever wants that installs it.
if ! have pkg-config || ! pkg-config --exists dart; then
  say "libdart-collision-bullet-dev is not installed: DART is left out"
fi

for package in $node_peers; do
  name=${package%@*} version=${package##*@}
  at=$build/npm/node_modules/$name/package.json
  grep -qs "\"version\": \"$version\"" "$at" && continue
  if may_install && have npm; then
    say "npm install $package"
    npm install --prefix "$build/npm" --no-audit --no-fund --loglevel=error "$package" >&2
  fi
  [ -f "$at" ] || say "$package is not installed: it is left out"
done
exit 0
