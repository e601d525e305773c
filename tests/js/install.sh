#!/bin/sh
# install.sh BUILD [SCALAR...]: builds the package in BUILD and installs the packed file into BUILD/installed, as a game
# would.
# SPDX-License-Identifier: MIT
#
# Beside it what the tests need of npm. Exits 77 where a tool is missing.
set -u
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P) || exit 1
sh "$here/../../src/js/build.sh" "$@"
status=$?
[ "$status" != 69 ] || exit 77
[ "$status" = 0 ] || exit "$status"
rm -rf "$1/installed"
mkdir -p "$1/installed" || exit 1
cd "$1/installed" || exit 1
echo '{"name": "game", "version": "1.0.0", "private": true, "type": "module"}' >package.json
npm install --silent --no-audit --no-fund "$(ls ../isostep-*.tgz)" ws@8 node-datachannel@0.33 typescript@5 \
  @types/node@20 @types/ws@8
