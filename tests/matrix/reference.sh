# What the targets are compared with: the tool's own build, and two programs of this folder's. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

# build_here NAME SOURCES AND LIBRARIES...: a program for this machine, unless it is newer than what it is made of.
build_here() {
  program=$matrix/$1
  shift
  [ -x "$program" ] && [ -z "$(find "$@" -newer "$program" | head -n 1)" ] && return 0
  # shellcheck disable=SC2086
  "$(compiler)" -std=c++20 -O1 -I"$root/include" -I"$root/scalar/include" "$@" -o "$program" >&2 ||
    fail 70 "$program cannot be built"
}

# make_reference: tool and prover from the sources as they are, the gate, and what flips bits of recordings.
make_reference() {
  if [ -n "${ISOSTEP_MATRIX_REFERENCE:-}" ]; then
    programs=$ISOSTEP_MATRIX_REFERENCE
    reference_tool=$programs/isostep reference_prover=$programs/isostep_prover
    gate_program=$programs/isostep_gate gate_controls=$programs/gate_controls.sh flip_program=$programs/flip_hash
    return 0
  fi
  build_tool matrix
  make_all tool isostep_prover || exit 70
  reference_tool=$tool reference_prover=$build/src/prover/isostep_prover
  build_here isostep_gate "$root"/tests/lint/gate/*.cpp
  build_here flip_hash "$root/tests/matrix/flip_hash.cpp" "$build/libisostep.a" "$build/libisostep_scalar.a"
  gate_program=$matrix/isostep_gate gate_controls=$root/tests/lint/gate/controls.sh flip_program=$matrix/flip_hash
}
