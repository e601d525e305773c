#!/bin/sh
# One match of four languages with the packages that were just made: the host in C++, clients in C, C# and, over the npm
# package's WebSockets, in node.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
[ -f "$root/tests/match/four_languages_test.sh" ] || not_here "tests/match is not in this copy"
[ -d "$work/npm/project/node_modules/isostep" ] || not_here "the package npm was not made"
have mono && have mcs || not_here "no mono"
cd "$work/npm/project" || exit 70
npm install --silent --no-audit --no-fund ws@8 || not_here "npm does not reach ws"
cmake --build "$build" --parallel "${ISOSTEP_PACKAGE_JOBS:-$(getconf _NPROCESSORS_ONLN)}" \
  --target match_host match_client_q32 isostep_tool isostep_c isostep_csharp_package || red "the match does not build"
sh "$root/tests/match/four_languages_test.sh" "$root" "$build/csharp/com.isostep.physics" "$build/tests/match/match_host" "$build/src/tool/isostep" \
  "$build/src/c/libisostep.so" "$build/tests/match/match_client" "$work/npm/project" q32 || red "the match fails"
green "3600 frames are equal in C++, C, C# and JavaScript; all recordings are verified"
