#!/bin/sh
# The three versions: this repository's go together, and copies in which they do not are refused, each by its rule.
# usage: versions_test.sh REPOSITORY
set -u
. "$1/tests/scratch.sh"
repository=$1
copy=$dir/copy
mkdir -p "$copy/src/packages/vcpkg/ports/isostep" "$copy/src/c/layout" "$copy/include/isostep/core" "$copy/replays" \
  "$copy/cmake"
for file in CMakeLists.txt CHANGELOG.md include/isostep/core/version.hpp src/c/layout/abi.hpp src/c/interface.json \
  src/packages/releases.tsv src/packages/vcpkg/ports/isostep/vcpkg.json cmake/behaviour_version.cmake; do
  cp "$repository/$file" "$copy/$file" || exit 1
done
grep '^S1 ' "$repository/replays/goldens.txt" >"$copy/replays/goldens.txt" || exit 1
tab=$(printf '\t')

versions() { sh "$repository/src/packages/versions.sh" "$@" >"$dir/out" 2>"$dir/err"; }
accepts() { versions "$copy" || fail "refused: $1"; }
refuses() { # what, words of the sentence
  versions "$copy"
  status=$?
  [ "$status" -eq 1 ] || fail "$1: exits $status, not 1"
  grep -q "$2" "$dir/err" || fail "$1 is refused in other words than '$2'"
}
version_of() { awk -F "$tab" -v name="$1" '$1 == name {print $2}' "$dir/out"; }
# set_version OLD NEW: in every file of the copy that states it.
set_version() {
  old=$(printf '%s' "$1" | sed 's/[.]/[.]/g')
  sed -i "s/VERSION $old /VERSION $2 /" "$copy/CMakeLists.txt"
  sed -i "s/^## $old/## $2/" "$copy/CHANGELOG.md"
  sed -i "s/\"version\": \"$old\"/\"version\": \"$2\"/" "$copy/src/c/interface.json" \
    "$copy/src/packages/vcpkg/ports/isostep/vcpkg.json"
  sed -i -e "s/kVersionText\[\] = \"$old\"/kVersionText[] = \"$2\"/" -e "s/kVersionMajor = .*/kVersionMajor = ${2%%.*};/" \
    -e "s/kVersionMinor = .*/kVersionMinor = $(echo "$2" | cut -d . -f 2);/" \
    -e "s/kVersionPatch = .*/kVersionPatch = ${2##*.};/" "$copy/include/isostep/core/version.hpp"
}

# This repository.
versions "$repository" || fail "the versions of this repository do not go together"
semantic=$(version_of semantic)
[ -n "$semantic" ] && [ -n "$(version_of abi)" ] || fail "a version is not printed"
[ "$(version_of behaviour | wc -c)" -eq 17 ] || fail "the behaviour version has not 16 digits"
minor=${semantic%.*}
next_patch=$minor.$((${semantic##*.} + 1))
next_minor=${semantic%%.*}.$((${minor##*.} + 1)).0

# A release is written down; the patch after it has the same hashes.
accepts "a copy with fewer goldens"
released=$(version_of behaviour)
versions --record "$copy" || fail "a release is not recorded"
[ "$(tail -n 1 "$copy/src/packages/releases.tsv")" = "$semantic$tab$(version_of abi)$tab$released" ] ||
  fail "the row of a release is another"
versions --record "$copy"
[ $? -eq 1 ] || fail "a release is recorded twice"
accepts "what was just released"
set_version "$semantic" "$next_patch"
accepts "a patch release with the same behaviour"

# One digit of one golden hash.
golden=$copy/replays/goldens.txt
cp "$golden" "$dir/golden"
sed -i '$s/.$/x/' "$golden"
refuses "a patch release with other hashes" "$semantic has $released: a patch release never changes behaviour"
set_version "$next_patch" "$next_minor"
sed -i 's/\*RESULT\*/*FIX*/' "$copy/CHANGELOG.md"
refuses "a minor release that hides its other hashes" "needs a \*RESULT\* line"
sed -i '/^## /a\
\
- *RESULT* Goldens regenerated, for a test.' "$copy/CHANGELOG.md"
accepts "a minor release that says that hashes change"
cp "$dir/golden" "$golden"
accepts "a minor release with the same behaviour"

# ABI: another one is another minor version's, and never an earlier one.
abi=$(version_of abi)
sed -i "s/kAbiVersion = $abi;/kAbiVersion = $((abi + 1));/" "$copy/src/c/layout/abi.hpp"
sed -i "s/^\"abi\": $abi/\"abi\": $((abi + 1))/" "$copy/src/c/interface.json"
accepts "a minor release with another ABI"
set_version "$next_minor" "$next_patch"
refuses "a patch release with another ABI" "ABI $((abi + 1)), but $semantic has $abi"
sed -i "s/^\"abi\": .*/\"abi\": $abi,/" "$copy/src/c/interface.json"
refuses "bindings for another ABI" "interface.json says $abi"

# Each file that states the version.
set_version "$next_patch" "$semantic"
sed -i "s/kAbiVersion = .*;/kAbiVersion = $abi;/" "$copy/src/c/layout/abi.hpp"
accepts "the copy as it was"
for file in CHANGELOG.md include/isostep/core/version.hpp src/c/interface.json src/packages/vcpkg/ports/isostep/vcpkg.json; do
  cp "$copy/$file" "$dir/kept"
  sed -i "s/$(printf '%s' "$semantic" | sed 's/[.]/[.]/g')/9.9.9/" "$copy/$file"
  refuses "$file with another version" "$file says 9.9.9, CMakeLists.txt $semantic"
  cp "$dir/kept" "$copy/$file"
done
printf '9.0.0\t%s\t%s\n' "$abi" "$released" >>"$copy/src/packages/releases.tsv"
refuses "a version before the last release" "is older than 9.0.0"
exit 0
