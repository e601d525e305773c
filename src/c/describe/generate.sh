#!/bin/sh
# The generated files of the C interface, into a folder: isostep.h, layout_checks.hpp, interface.json, abi.txt; calls.inl for tests/c.
# usage: generate.sh ISOSTEP_INTERFACE CC ROOT OUT
# SPDX-License-Identifier: MIT
set -eu
tool=$1 cc=$2 root=$3 out=$4
mkdir -p "$out"
"$tool" header "$root" "$out/isostep.h" "$out/layout_checks.hpp"
"$cc" -E -P -DISO_API=ISO_FUNCTION "$out/isostep.h" >"$out/isostep.expanded"
"$tool" json "$root" "$out/isostep.h" "$out/isostep.expanded" "$out/interface.json" "$out/abi.txt" \
  "$out/calls.inl"
rm "$out/isostep.expanded"
