#!/bin/sh
# The overlay port: its files are valid, and its portfile runs against stand-ins for vcpkg's functions, for vcpkg itself
# is no package of Debian's. Not tried: vcpkg.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
port=$packages/vcpkg/ports/isostep
at=$work/vcpkg
rm -rf "$at" && mkdir -p "$at/packages" || exit 70

# Every feature that the portfile knows is one of the manifest, and every option one of CMakeLists.txt.
cmake "-DPORT=$port" "-DROOT=$root" -P "$packages/vcpkg/check_port.cmake" || red "the port's files do not fit together"
cmake "-DPORT=$port" "-DBUILD=$build" "-DWORK=$at" "-DCURRENT_PACKAGES_DIR=$at/packages" -P "$packages/vcpkg/stand_in.cmake" ||
  red "the portfile does not run"
cp -R "$port" "$out/vcpkg-port" 2>/dev/null || exit 70
cmake -S "$packages/consumer" -B "$at/consumer" "-DCMAKE_PREFIX_PATH=$at/packages" -DCMAKE_BUILD_TYPE=Release \
  "-DEXAMPLES=$root/src/examples" >"$at/consumer.log" 2>&1 && cmake --build "$at/consumer" >>"$at/consumer.log" 2>&1 ||
  { cat "$at/consumer.log"; red "what the port installs does not serve"; }
prints_goldens "$at/consumer/four_scalars_c"
prints_goldens "$at/consumer/four_scalars_cpp"
green "valid manifest; the portfile ran with stand-ins for vcpkg, which is not here"
