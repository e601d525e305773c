#!/bin/sh
# ./isostep bench refuses what it does not know, at once and in one line; peers that cannot be brought are named, a line each.
# usage: words_test.sh REPOSITORY
# SPDX-License-Identifier: MIT
set -u
repository=$1
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
failures=0
fail() {
  echo "bench: $1" >&2
  failures=$((failures + 1))
}

for words in '' nonsense scene '*' --help; do
  # shellcheck disable=SC2086
  (set -f && ISOSTEP_BUILD_DIR=$scratch/build "$repository/isostep" bench $words) >"$scratch/out" 2>"$scratch/error"
  status=$?
  [ "$status" -eq 64 ] || fail "'bench $words' exits $status, not 64"
  [ -s "$scratch/out" ] && fail "'bench $words' prints to stdout"
  [ "$(wc -l <"$scratch/error")" -eq 1 ] || fail "'bench $words' says more or less than one line"
  grep -qF "no benchmark '$words'; there are: scenes scale threads rollback particles convex coarse projections" "$scratch/error" || fail "'bench $words' says: $(cat "$scratch/error")"
  [ -e "$scratch/build" ] && fail "'bench $words' builds"
done

# A machine with nothing on it but grep.
mkdir "$scratch/bin" && ln -s "$(command -v grep)" "$scratch/bin/grep"
shell=$(command -v sh)
PATH=$scratch/bin ISOSTEP_NO_INSTALL=1 "$shell" "$repository/bench/peers.sh" "$scratch/none" 2>"$scratch/error" ||
  fail "peers.sh exits $? where nothing can be installed"
for peer in libbullet-dev libode-dev gnuplot-nox nodejs npm rapier3d-simd-compat@ rapier3d-deterministic-compat@; do
  [ "$(grep -c "$peer.* is not installed" "$scratch/error")" -eq 1 ] || fail "peers.sh has no line for $peer"
done

# The laboratory's pages name the versions that are brought.
versions=$(grep -o '@[0-9][0-9.]*[0-9]' "$repository/bench/peers.sh" | tr -d @)
[ "$(printf '%s\n' "$versions" | wc -l)" -eq 6 ] || fail "peers.sh brings other packages than six"
for version in $versions; do
  grep -qF "$version" "$repository/src/tool/lab/report/engines.cpp" || fail "engines.cpp does not name version $version"
done

[ "$failures" -eq 0 ] && echo "bench: words as expected"
exit "$failures"
