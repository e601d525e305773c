#!/bin/sh
# isostep.dll for x86-64 by mingw-w64, with import libraries for mingw and Microsoft's linker, the header, and the example
# linked against it, which wine runs. Its functions are C's: who links it needs no mingw.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
triplet=x86_64-w64-mingw32
have $triplet-g++-posix || not_here "no $triplet-g++-posix (g++-mingw-w64-x86-64-posix)"
at=$work/windows
mkdir -p "$at" && cd "$root" || exit 70
export CCACHE_BASEDIR="$root"
generator=''
if have ninja; then generator=-GNinja; fi
# Thirty files at a time, as the matrix compiles for other targets.
# shellcheck disable=SC2086
cmake -S "$root" -B "$at/build" $generator -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/cross.cmake" \
  -DISOSTEP_TARGET=windows -DCMAKE_BUILD_TYPE=Release -DISOSTEP_C=ON -DISOSTEP_TOOL=OFF -DISOSTEP_PROVER=OFF \
  -DISOSTEP_TESTS=OFF -DISOSTEP_EXAMPLES=OFF -DISOSTEP_INSTALL=OFF -DCMAKE_SHARED_LINKER_FLAGS=-static \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=30 || red "it does not configure"
cmake --build "$at/build" --parallel "${ISOSTEP_PACKAGE_JOBS:-$(getconf _NPROCESSORS_ONLN)}" --target isostep_c ||
  red "it does not build"

name=isostep-$version-windows-x86_64
to=$at/$name
rm -rf "$to" && mkdir -p "$to/bin" "$to/lib" "$to/include" || exit 70
dll=$(find "$at/build/src/c" -name '*isostep*.dll' | head -n 1)
[ -f "$dll" ] || red "no DLL was built"
cp "$dll" "$to/bin/isostep.dll" || exit 70
$triplet-strip "$to/bin/isostep.dll"
cp "$root/src/c/include/isostep.h" "$to/include/" && cp "$root/LICENSE" "$root/src/examples/four_scalars.c" "$to/" || exit 70
cp "$packages/windows/README.md" "$to/README.md" || exit 70

# What it exports, and nothing else; what it imports is Windows' own.
$triplet-objdump -p "$to/bin/isostep.dll" >"$at/dump" || exit 70
exported=$(awk '/^\[Ordinal\/Name Pointer\] Table/ {inside = 1; next} inside && /^\t\[/ {print $NF} inside && /^$/ {exit}' "$at/dump")
[ "$(echo "$exported" | grep -c '^iso_')" -gt 100 ] || red "the DLL does not export the interface"
strange=$(echo "$exported" | grep -v '^iso_' | head -n 1)
[ -z "$strange" ] || red "the DLL exports $strange"
needed=$(sed -n 's/^\tDLL Name: //p' "$at/dump" | tr '[:upper:]' '[:lower:]' | grep -v -e '^kernel32.dll$' -e '^msvcrt.dll$' \
  -e '^api-ms-win-crt-' -e '^ucrtbase.dll$')
[ -z "$needed" ] || red "the DLL needs $(echo "$needed" | head -n 1)"
{
  echo 'LIBRARY isostep.dll'
  echo EXPORTS
  echo "$exported"
} >"$to/lib/isostep.def"
for import in libisostep.dll.a isostep.lib; do
  $triplet-dlltool -d "$to/lib/isostep.def" -D isostep.dll -l "$to/lib/$import" || red "no $import"
done

# The example as the README says.
$triplet-gcc -std=c99 "$to/four_scalars.c" "-I$to/include" "-L$to/lib" -lisostep -o "$to/bin/four_scalars.exe" ||
  red "the example does not link"
rm -f "$out/$name.zip"
if have zip; then (cd "$at" && zip -qr "$out/$name.zip" "$name"); else
  (cd "$at" && cmake -E tar cf "$out/$name.zip" --format=zip "$name") || exit 70
fi
wine=$(command -v wine64 || ls /usr/lib/wine/wine64 2>/dev/null) || wine=''
[ -n "$wine" ] || not_here "$name.zip is built; there is no wine64 to run its example"
export WINEPREFIX="$at/wine" WINEDEBUG=-all
prints_goldens "$wine" "$to/bin/four_scalars.exe"
green "$name.zip, $(du -h "$out/$name.zip" | cut -f 1), $(echo "$exported" | wc -l) functions; run by wine"
