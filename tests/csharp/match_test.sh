#!/bin/sh
# A C# client plays a C++ host: 3600 frames across 150 ms +-40 each way, 5 % lost.
# usage: match_test.sh REPOSITORY LIBISOSTEP MATCH_HOST
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
assembly "$1" "$2"
cp "$3" "$dir/libmatch_host.so" || fail "no $3"
each_family "$1/tests/csharp/Peer.cs.in" Peer
mcs -warnaserror -unsafe -optimize+ -r:"$dir/Isostep.dll" -out:"$dir/match.exe" "$1/tests/csharp/MatchTest.cs" \
  "$dir/PeerFixed32.cs" "$dir/PeerF32.cs" >"$dir/out" 2>&1 || fail "the game does not compile"
mono "$dir/match.exe" >"$dir/out" 2>"$dir/err" || fail "the match differs"
cat "$dir/out"
