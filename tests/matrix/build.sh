# Configures and builds the prover for a loaded target. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

# Flags take the place of CMake's own for Release; a toolchain's stay in front of them. Thirty files are compiled as
# one, a third sooner; the reference and the tests take them one by one.
configuration() {
  printf '%s\n' -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=$flags -DNDEBUG" \
    "-DISOSTEP_SCALARS=$(printf '%s' "$scalars" | tr ' ' ';')" \
    -DISOSTEP_TOOL=OFF -DISOSTEP_EXAMPLES=OFF -DISOSTEP_TESTS=OFF -DISOSTEP_INSTALL=OFF -DISOSTEP_PROVER=ON \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=30
  [ -z "$cmake_options" ] || printf '%s\n' "$cmake_options"
  [ "$compiler" = cross ] || printf '%s\n' "-DCMAKE_CXX_COMPILER=$compiler"
  [ "$toolchain" = - ] ||
    printf '%s\n' "-DCMAKE_TOOLCHAIN_FILE=$root/cmake/toolchains/cross.cmake" "-DISOSTEP_TARGET=$toolchain"
}

# circumstances: what decides besides what an old build was made of: a newer compiler, other flags of the toolchain.
circumstances() {
  "$(command_of_compiler)" --version 2>/dev/null | head -n 1
  toolchain_flags
}

# configure_target: unless it is configured so already. A line an argument: flags hold blanks.
configure_target() {
  wanted=$(configuration)
  made_of=$(configuration && circumstances)
  if [ -f "$at/build/CMakeCache.txt" ] && [ "$(cat "$at/configuration" 2>/dev/null)" = "$made_of" ]; then return 0; fi
  rm -rf "$at/build" "$at/configuration"
  mkdir -p "$at/build" || return 1
  generator=''
  if have ninja; then generator=-GNinja; fi
  set --
  while IFS= read -r argument; do [ -z "$argument" ] || set -- "$@" "$argument"; done <<LIST
$wanted
LIST
  limited 300 cmake -S "$project" -B "$at/build" $generator "$@" >"$at/configure.log" 2>&1 || return 1
  printf '%s\n' "$made_of" >"$at/configuration"
}

# build_target: goes on where an interrupted build ended.
build_target() {
  configure_target || { log=$at/configure.log; return 1; }
  log=$at/build.log
  limited 2400 cmake --build "$at/build" --target isostep_prover --parallel "$build_jobs" >"$log" 2>&1
}

# quoted TEXT: one word of sh's.
quoted() { printf "'%s'\n" "$(printf '%s' "$1" | sed "s/'/'\\\\''/g")"; }

# program_of: the prover of a loaded target, as the shell starts it at the root of the repository; "reference" built
# none, it has the tool's.
program_of() {
  if [ "$compiler" = reference ]; then
    program=$reference_prover
  else
    program=$(find "$at/build/src/prover" -maxdepth 1 \( -name isostep_prover -o -name 'isostep_prover.*' \) |
      head -n 1)
  fi
  prover="$runner${runner:+ }$(quoted "$program")${simd:+ --simd $simd}"
  [ -n "$program" ]
}

# toolchain_flags: what the toolchain file begins with, in cross.cmake's table.
toolchain_flags() {
  [ "$toolchain" = - ] ||
    sed -n "s/^ *\"$toolchain|[^|]*|[^|]*|[^|]*|\([^|]*\)|.*/\1/p" "$root/cmake/toolchains/cross.cmake"
}

# The libraries that a loaded target is made of, a line each, for the gate.
libraries_of() {
  if [ "$compiler" = reference ]; then from=$build; else from=$at/build; fi
  find "$from" -maxdepth 1 -name 'libisostep*.a'
}
