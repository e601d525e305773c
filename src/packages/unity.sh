#!/bin/sh
# The package for Unity's package manager, with the libraries of this machine and, where it was built, of Windows. Its
# sources compile and run outside Unity, which is not here to import them.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
[ -f "$root/src/csharp/package/package.json" ] || not_here "src/csharp is not in this copy"
cmake --build "$build" --target isostep_unity_package || red "isostep_unity_package fails"
staged=$build/unity/com.isostep.physics
dll=$work/windows/isostep-$version-windows-x86_64/bin/isostep.dll
if [ -f "$dll" ]; then
  mkdir -p "$staged/Runtime/Plugins/windows-x86_64" && cp "$dll" "$staged/Runtime/Plugins/windows-x86_64/" || exit 70
  "$(find "$build/src/csharp" -name isostep_csharp -type f)" metas "$staged" || red "the metas cannot be written"
fi
# What begins with a dot or ends in ~ Unity does not import.
bare=$(cd "$staged" && find . -mindepth 1 ! -path '*/.*' ! -path '*~*' ! -name '*.meta' | while read -r file; do
  [ -f "$file.meta" ] || echo "$file"
done | head -n 1)
[ -z "$bare" ] || red "$bare has no .meta: Unity ignores it in an installed package"
file=com.isostep.physics-$version.tgz
tar -czf "$out/$file" -C "$build/unity" --transform 's/^com.isostep.physics/package/' com.isostep.physics || exit 70
have mcs && have mono || not_here "$file is packed; no mcs and mono to try it (mono-mcs mono-runtime)"
mkdir -p "$work/unity" && csharp_example "$staged/Runtime" "$work/unity/four_scalars.exe" || red "its sources do not compile"
prints_goldens env "LD_LIBRARY_PATH=$staged/Runtime/Plugins/linux-x86_64" mono "$work/unity/four_scalars.exe"
green "$file, $(du -h "$out/$file" | cut -f 1); compiled and run by mono, not imported by Unity"
