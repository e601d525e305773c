#!/bin/sh
# cmake --install, and a program of each language against what it installed, after the prefix has moved elsewhere.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
at=$work/installed
rm -rf "$at" && mkdir -p "$at" || exit 70
cmake --install "$build" --prefix "$at/first" || red "cmake --install fails"
mv "$at/first" "$at/prefix" || exit 70
prefix=$at/prefix
examples=$root/src/examples

# C, by pkg-config: its file finds the prefix where it is now.
pc=$(find "$prefix" -name isostep.pc) || exit 1
[ -n "$pc" ] || red "isostep.pc is not installed"
lib=$(dirname "$(dirname "$pc")")
cc=${CC:-cc}
if have pkg-config; then
  [ "$(PKG_CONFIG_PATH=$(dirname "$pc") pkg-config --modversion isostep)" = "$version" ] || red "isostep.pc has another version"
  # shellcheck disable=SC2046
  "$cc" -std=c99 -pedantic -Wall -Wextra -Werror "$examples/four_scalars.c" -o "$at/by_pkg_config" \
    $(PKG_CONFIG_PATH=$(dirname "$pc") pkg-config --cflags --libs isostep) "-Wl,-rpath,$lib" ||
    red "four_scalars.c does not compile with isostep.pc"
  prints_goldens "$at/by_pkg_config"
fi

# C and C++ by CMake.
cmake -S "$packages/consumer" -B "$at/consumer" "-DCMAKE_PREFIX_PATH=$prefix" -DCMAKE_BUILD_TYPE=Release \
  "-DEXAMPLES=$examples" >"$at/consumer.log" 2>&1 &&
  cmake --build "$at/consumer" >>"$at/consumer.log" 2>&1 || { cat "$at/consumer.log"; red "find_package(isostep) does not serve"; }
prints_goldens "$at/consumer/four_scalars_c"
prints_goldens "$at/consumer/four_scalars_cpp"

# Python, without a build folder to find anything in.
[ -f "$prefix/share/isostep/python/isostep/__init__.py" ] || red "Python is not installed"
if have "$python"; then
  prints_goldens env -u ISOSTEP_LIBRARY "PYTHONPATH=$prefix/share/isostep/python" PYTHONDONTWRITEBYTECODE=1 "$python" \
    "$root/src/python/examples/four_scalars.py"
fi

# C#, its sources compiled from where they are installed.
if [ -d "$root/src/csharp" ]; then
  sources=$prefix/share/isostep/csharp
  [ -d "$sources" ] || red "the C# sources are not installed"
  if have mcs && have mono; then
    csharp_example "$sources" "$at/four_scalars.exe" || red "the installed C# sources do not compile"
    prints_goldens env "LD_LIBRARY_PATH=$lib" mono "$at/four_scalars.exe"
  fi
fi
green "C, C++, Python in $(find "$prefix" -type f | wc -l) files, $(du -sh "$prefix" | cut -f 1)"
