# What the scripts of the packages share. Sourced; ./isostep package sets the variables.
# SPDX-License-Identifier: MIT
set -u
root=$ISOSTEP_ROOT build=$ISOSTEP_BUILD work=$ISOSTEP_WORK out=$ISOSTEP_OUT
packages=$root/src/packages
goldens=$work/hello.txt  # what the example of every package must print

have() { command -v "$1" >/dev/null 2>&1; }
# not_here WHY: this package cannot be made on this machine. red WHY: it can, and is wrong. Both as the log's last line.
not_here() { echo "$1"; exit 69; }
red() { echo "$1"; exit 1; }
# green WHAT: for the table.
green() { echo "$1"; exit 0; }

version=$(sed -n 's/^project(isostep VERSION \([0-9.]*\) .*/\1/p' "$root/CMakeLists.txt")
abi=$(sed -n 's/.*kAbiVersion = \([0-9]*\);.*/\1/p' "$root/src/c/layout/abi.hpp")

# prints_goldens COMMAND...: runs it; its output must be that of the build's own example.
prints_goldens() {
  echo "+ $*"
  "$@" >"$work/printed.txt" || red "'$*' exits $?"
  tr -d '\r' <"$work/printed.txt" >"$work/printed.unix"
  cat "$work/printed.unix"
  cmp -s "$work/printed.unix" "$goldens" || red "'$*' does not print the goldens"
}

# commands_of PAGE: those of its sh blocks.
commands_of() { awk '/^```sh$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$1"; }

# The system's Python where there is one, for that one has numpy and sees installed packages.
python=/usr/bin/python3
[ -x "$python" ] || python=python3

# csharp_example SOURCES PROGRAM: the C# files below SOURCES and the example over four scalars, compiled by mcs.
csharp_example() {
  mkdir -p "$work/csharp" || exit 70
  while read -r space number from; do
    sed "s/@NS@/$space/g; s/@S@/$number/g; s/@FROM@/$from/g" "$packages/unity/Crate.cs.in" >"$work/csharp/$space.cs" || exit 70
  done <<LIST
F32 float (float)
F64 double (double)
Fixed16 Q16 Q16.FromDouble
Fixed32 Q32 Q32.FromDouble
LIST
  # shellcheck disable=SC2046
  mcs -unsafe -out:"$2" $(find "$1" -name '*.cs') "$work"/csharp/*.cs "$packages/unity/FourScalars.cs"
}
