#!/bin/sh
# A C# client plays a C++ host, in floating point and in fixed point.
# usage: match_test.sh REPOSITORY PACKAGE LIBISOSTEP MATCH_HOST ISOSTEP
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
puck_client "$1" "$2" "$3"
for scalar in f32 q32; do
  sh "$1/tests/match/match_test.sh" "$4" "$5" "$scalar" "mono '$dir/client.exe' $scalar" || exit 1
done
