# The disassembly gate for a loaded target: that it would see there what it must, and that it sees nothing in the
# library. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

gate_seconds=600 # that reading one library may take

# read_library: the gate's word on what the compiler made of the library; on what the linker made, where it compiles.
read_library() {
  set -- "${tools}objdump" "${tools}nm"
  case $flags in
    *-flto*) set -- --functions isostep "$@" "$program" ;;
    *)
      while IFS= read -r library; do [ -z "$library" ] || set -- "$@" "$library"; done <<LIST
$(libraries_of)
LIST
      ;;
  esac
  limited "$gate_seconds" "$gate_program" "$@"
}

# target_flags: what a compiler is told besides its flags when it compiles for the loaded target by hand.
target_flags() {
  case $compiler,$toolchain in
    clang*,wasm*) echo --target=wasm32-wasi ;;
    clang*,-) ;;
    clang*) echo "--target=${tools%-}" ;;
  esac
  toolchain_flags
}

# check_gate: controls first, for a gate that sees nothing finds nothing.
check_gate() {
  log=$at/gate.log
  # shellcheck disable=SC2046,SC2086
  limited 300 sh "$gate_controls" "$gate_program" "${tools}objdump" "${tools}nm" "$(command_of_compiler)" \
    $(target_flags) $flags >"$log" 2>&1 || { reason="the gate's controls fail"; return 1; }
  read_library >>"$log" 2>&1
  case $? in
    0) ;;
    124 | 137) reason="the gate took longer than $gate_seconds s"; return 1 ;;
    *) reason="the gate: $(tail -n 1 "$log")"; return 1 ;;
  esac
}

# check_gate_finds CONCERN: in a control, at least one.
check_gate_finds() {
  log=$at/gate.log
  read_library >"$log" 2>&1
  gated=$(tail -n 1 "$log" | grep -Eo "[0-9]+ $1") || { gated=clean; reason="the gate finds nothing $1"; return 1; }
}
