#!/bin/sh
# What is generated is what is committed.
# usage: generated_test.sh GENERATED SOURCE
# SPDX-License-Identifier: MIT
set -u
failures=0
for file in include/isostep.h:isostep.h layout/layout_checks.hpp:layout_checks.hpp interface.json:interface.json; do
  cmp "$1/${file#*:}" "$2/${file%:*}" || failures=$((failures + 1))
done
[ "$failures" -eq 0 ] || echo "run: cmake --build BUILD --target isostep_interface_write" >&2
exit "$failures"
