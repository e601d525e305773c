#!/bin/sh
# Sizes of the library and of the packages that were made, as a table in MB.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"

megabytes() { awk -v bytes="$1" 'BEGIN {printf "%.2f", bytes / 1e6}'; }
row() { # name, file
  case $2 in
    *.so | *.dll) small=$(megabytes "$(gzip -c "$2" | wc -c)") ;;
    *) small=- ;;
  esac
  printf '%-44s %8s %8s\n' "$1" "$(megabytes "$(wc -c <"$2")")" "$small"
}

printf '%-44s %8s %8s\n' file MB gzipped
for library in src/c/libisostep.so src/c/udp/libisostep_udp.so; do
  [ -f "$build/$library" ] || continue
  name=$(basename "$library")
  cp "$build/$library" "$work/$name" && strip "$work/$name" || exit 70
  row "$name" "$work/$name"
  rm "$work/$name"
done
dll=$work/windows/isostep-$version-windows-x86_64/bin/isostep.dll
for file in "$build/libisostep.a" "$dll" "$out"/*; do
  [ ! -f "$file" ] || row "$(basename "$file")" "$file"
done
