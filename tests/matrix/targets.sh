# The tables: which targets there are, and what each is. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

tab=$(printf '\t')

# rows TABLE: its lines without comments and head.
rows() { grep -v '^#' "$tables/$1.tsv" | tail -n +2; }

# row_of TABLE NAME: the line that begins with that name; fails where none does.
row_of() { rows "$1" | awk -F '\t' -v name="$2" '$1 == name {print; found = 1} END {exit !found}'; }

# names_of TABLE [COLUMN]: of every line that has something in that column.
names_of() { rows "$1" | awk -F '\t' -v column="${2:-1}" '$column != "-" {print $1}'; }

# load_target NAME: what its line and its machine's say, as variables.
load_target() {
  target=$1
  row=$(row_of targets "$target") || return 1
  IFS=$tab read -r _ machine compiler flags fast full options <<LINE
$row
LINE
  prepare_target
}

# load_control NAME: the same for a line of controls.tsv.
load_control() {
  target=$1
  row=$(row_of controls "$target") || return 1
  IFS=$tab read -r _ machine compiler flags fast full forced past gate <<LINE
$row
LINE
  options=-DISOSTEP_SIMD=OFF
  [ "$compiler" != reference ] || options='' # not built for the control
  prepare_target
}

# prepare_target: what follows from the columns.
prepare_target() {
  IFS=$tab read -r _ toolchain runner tools floats budget needs <<LINE
$(row_of machines "$machine")
LINE
  scalars=$full
  if [ "$set" = fast ] && [ "$fast" != - ]; then scalars=$fast; fi # "-": named by --target, though not of this set
  [ "$scalars" != all ] || scalars=$all_scalars
  [ "$runner" != - ] || runner=''
  [ "$tools" != - ] || tools=''
  [ "$needs" != - ] || needs=''
  cmake_options='' simd='' cpu=''
  for word in $options; do
    case $word in
      -D*) cmake_options="$cmake_options${cmake_options:+
}$word" ;;
      simd:*) simd=${word#simd:} ;;
      cpu:*) cpu=${word#cpu:} ;;
      short) floats=short ;;
      tools:*) tools=${word#tools:} ;;
    esac
  done
  at=$matrix/$target
}

# The command of the compiler of a loaded target.
command_of_compiler() {
  case $compiler in
    reference) sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt" 2>/dev/null ;;
    cross)
      case $toolchain in
        windows) printf '%sg++-posix\n' "$tools" ;;
        *) printf '%sg++\n' "$tools" ;;
      esac
      ;;
    *) printf '%s\n' "$compiler" ;;
  esac
}

# name_of_compiler: "g++ 12.2.0", as the table shows it.
name_of_compiler() {
  command=$(command_of_compiler)
  case $("$command" --version 2>/dev/null | head -n 1) in
    '') printf '%s\n' "$(basename "$command")" ;;
    *clang*) printf 'clang++ %s\n' "$("$command" -dumpversion)" ;;
    *) printf 'g++ %s\n' "$("$command" -dumpfullversion)" ;;
  esac
}

# name_of SCALAR: as recordings are called.
name_of() {
  case $1 in
    Q*) printf '%s\n' "$1" | tr Q_ q. ;;
    *) printf '%s\n' "$1" ;;
  esac
}

# This machine can run what is built for the CPU that a loaded target is for.
cpu_can() { [ -z "$cpu" ] || grep -qw "^flags.*$cpu" /proc/cpuinfo 2>/dev/null; }
