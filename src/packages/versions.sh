#!/bin/sh
# The three versions of isostep, and whether they may go together: semantic (source), ABI (soname), behaviour (hashes).
# usage: versions.sh [--record] [REPOSITORY]    --record: the row of a release, at the end of releases.tsv
# Prints a line for each version. Exits 0, 1 when a rule of README.md is broken, 70 when a version cannot be read.
# SPDX-License-Identifier: MIT
set -u
record=''
if [ "${1:-}" = --record ]; then
  record=yes
  shift
fi
root=${1:-$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd -P)}
releases=$root/src/packages/releases.tsv
broken=0

unreadable() { echo "versions: $1" >&2; exit 70; }
refuse() {
  echo "versions: $1" >&2
  broken=1
}

# text_of FILE EXPRESSION: what sed's EXPRESSION prints of it, its first line.
text_of() { sed -n "$2" "$root/$1" 2>/dev/null | head -n 1; }
json_version='s/^ *"version": "\([^"]*\)".*/\1/p'

semantic=$(text_of CMakeLists.txt 's/^project(isostep VERSION \([0-9.]*\) .*/\1/p')
case $semantic in
  [0-9]*.[0-9]*.[0-9]*) ;;
  *) unreadable "CMakeLists.txt: no project(isostep VERSION MAJOR.MINOR.PATCH" ;;
esac
# minor_of VERSION: "0.1" of "0.1.7"; patch releases share it.
minor_of() { printf '%s\n' "${1%.*}"; }
constant_of() { text_of include/isostep/core/version.hpp "s/.*$1 = \([0-9]*\);/\1/p"; }

# What states the version beside CMakeLists.txt. Folders of other languages may be absent in a trimmed copy.
same_version() { # file, what it states
  [ "$2" = "$semantic" ] || refuse "$1 says ${2:-nothing}, CMakeLists.txt $semantic"
}
same_version include/isostep/core/version.hpp "$(text_of include/isostep/core/version.hpp 's/.*kVersionText\[\] = "\(.*\)";/\1/p')"
same_version include/isostep/core/version.hpp \
  "$(constant_of kVersionMajor).$(constant_of kVersionMinor).$(constant_of kVersionPatch)"
same_version CHANGELOG.md "$(text_of CHANGELOG.md 's/^## \([0-9.]*\).*/\1/p')"
for json in src/c/interface.json src/packages/vcpkg/ports/isostep/vcpkg.json src/js/package.json src/csharp/package/package.json; do
  [ ! -d "$(dirname "$root/$json")" ] || same_version "$json" "$(text_of "$json" "$json_version")"
done

abi=$(text_of src/c/layout/abi.hpp 's/.*kAbiVersion = \([0-9]*\);.*/\1/p')
[ -n "$abi" ] || unreadable "src/c/layout/abi.hpp: no kAbiVersion"
described=$(text_of src/c/interface.json 's/^"abi": \([0-9]*\).*/\1/p')
[ "$described" = "$abi" ] || refuse "src/c/interface.json says $described, src/c/layout/abi.hpp $abi"

work=$(mktemp -d) || exit 70
trap 'rm -rf "$work"' EXIT
cmake "-DGOLDENS=$root/replays/goldens.txt" "-DOUT=$work/behaviour" -P "$root/cmake/behaviour_version.cmake" >&2 ||
  unreadable "replays/goldens.txt cannot be read"
behaviour=$(sed -n 's/.*return 0x\([0-9a-f]*\)u;.*/\1/p' "$work/behaviour")
[ -n "$behaviour" ] || unreadable "cmake/behaviour_version.cmake: no behaviour version"

printf 'semantic\t%s\nabi\t%s\nbehaviour\t%s\n' "$semantic" "$abi" "$behaviour"

# at_least A B: whether version A is not older than B.
at_least() {
  [ "$(printf '%s\n%s\n' "$1" "$2" | sort -t . -k 1,1n -k 2,2n -k 3,3n | head -n 1)" = "$2" ]
}
# says_result VERSION: its section of CHANGELOG.md says that hashes change.
says_result() {
  awk -v head="## $1" 'index($0, "## ") == 1 {inside = index($0, head) == 1} inside && /^- .*\*RESULT\*/ {found = 1}
    END {exit !found}' "$root/CHANGELOG.md"
}

[ -f "$releases" ] || unreadable "src/packages/releases.tsv is not there"
last=$(grep -v '^#' "$releases" | tail -n 1)
if [ -n "$last" ]; then
  released=$(printf '%s\n' "$last" | cut -f 1)
  released_abi=$(printf '%s\n' "$last" | cut -f 2)
  released_behaviour=$(printf '%s\n' "$last" | cut -f 3)
  at_least "$semantic" "$released" || refuse "$semantic is older than $released, which is released"
  if [ "$(minor_of "$semantic")" = "$(minor_of "$released")" ]; then
    [ "$behaviour" = "$released_behaviour" ] ||
      refuse "behaviour $behaviour, but $released has $released_behaviour: a patch release never changes behaviour"
    [ "$abi" = "$released_abi" ] || refuse "ABI $abi, but $released has $released_abi: a patch release never changes it"
  elif [ "$behaviour" != "$released_behaviour" ]; then
    says_result "$semantic" ||
      refuse "behaviour is no longer that of $released: the section $semantic of CHANGELOG.md needs a *RESULT* line"
  fi
  [ "$abi" -ge "$released_abi" ] || refuse "ABI $abi is lower than that of $released, $released_abi"
fi
# Every tag of a version has its row: what is not written down cannot be compared with.
for tag in $(git -C "$root" tag --list 'v[0-9]*' 2>/dev/null); do
  grep -q "^${tag#v}	" "$releases" || refuse "tag $tag has no row in src/packages/releases.tsv"
done

[ "$broken" = 0 ] || exit 1
if [ -n "$record" ]; then
  ! grep -q "^$semantic	" "$releases" || { refuse "$semantic is recorded already"; exit 1; }
  printf '%s\t%s\t%s\n' "$semantic" "$abi" "$behaviour" >>"$releases" || exit 74
fi
