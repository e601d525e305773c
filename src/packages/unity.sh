#!/bin/sh
# The package for Unity's package manager: every file has its .meta, the native libraries are in their places, and the
# sources compile and run outside Unity, which is not here to import them.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
[ -f "$root/src/csharp/package/package.json" ] || not_here "src/csharp is not in this copy"
at=$work/unity/isostep
rm -rf "$work/unity" && mkdir -p "$work/unity" && cp -R "$root/src/csharp/package" "$at" || exit 70

# plugin FILE FOLDER: a native library, where the assembly looks for it.
plugin() { mkdir -p "$at/Runtime/Plugins/$2" && cp "$1" "$at/Runtime/Plugins/$2/$3" || exit 70; }
library=$(find "$build/src/c" -name "libisostep.so.$abi" | head -n 1)
[ -z "$library" ] || plugin "$library" x86_64 libisostep.so
dll=$work/windows/isostep-$version-windows-x86_64/bin/isostep.dll
[ ! -f "$dll" ] || plugin "$dll" x86_64 isostep.dll
if [ -f "$root/src/csharp/meta.sh" ]; then sh "$root/src/csharp/meta.sh" "$at" || red "src/csharp/meta.sh fails"; fi
# What begins with a dot or ends in ~ Unity does not import.
bare=$(cd "$at" && find . -mindepth 1 -not -path '*/.*' -not -path '*~*' -not -name '*.meta' | while read -r file; do
  [ -f "$file.meta" ] || echo "$file"
done | head -n 1)
[ -z "$bare" ] || red "$bare has no .meta: Unity ignores it in an installed package"
(cd "$work/unity" && tar -czf "$out/isostep-unity-$version.tgz" --transform 's/^isostep/package/' isostep) || exit 70
have mcs && have mono || not_here "packed; no mcs and mono to compile it (mono-mcs mono-runtime)"
example=$root/src/csharp/examples/FourScalars.cs
[ -f "$example" ] || red "src/csharp has no examples/FourScalars.cs"
# shellcheck disable=SC2046
mcs -unsafe -langversion:7.2 -out:"$work/unity/four_scalars.exe" $(find "$at/Runtime" -name '*.cs') "$example" ||
  red "its sources do not compile"
prints_goldens env "LD_LIBRARY_PATH=$at/Runtime/Plugins/x86_64" mono "$work/unity/four_scalars.exe"
green "isostep-unity-$version.tgz; compiled and run by mono, not imported by Unity"
