#!/bin/sh
# The npm package: built by src/js/build.sh, installed into an empty project, an example run by node; then its tests,
# where npm reaches a registry.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
[ -f "$root/src/js/build.sh" ] || not_here "src/js is not in this copy"
have npm && have node || not_here "no npm"
at=$work/npm
mkdir -p "$at" || exit 70
export JOBS="${ISOSTEP_PACKAGE_JOBS:-$(getconf _NPROCESSORS_ONLN)}"
sh "$root/src/js/build.sh" "$build/js" q32 f32 f64 q16 || {  # where the tests have it too
  case $? in
    69) not_here "$(tail -n 1 "$work/npm.log")" ;;
    *) red "src/js/build.sh fails" ;;
  esac
}
file=$(ls "$build"/js/isostep-*.tgz) || red "src/js/build.sh packs nothing"
cp "$file" "$out/" || exit 70
rm -rf "$at/project" && mkdir "$at/project" && cd "$at/project" || exit 70
echo '{"name": "consumer", "private": true, "type": "module"}' >package.json
npm install --silent --no-audit --no-fund --offline "$file" || red "npm install fails"
cp "$packages/npm/four_scalars.mjs" . || exit 70
prints_goldens node four_scalars.mjs
[ "$(node node_modules/isostep/example/hello.mjs)" = "$(grep '^q32 ' "$goldens")" ] ||
  red "hello.mjs does not print the golden"
made="$(basename "$file"), $(du -h "$file" | cut -f 1)"
npm view --silent ws version >/dev/null 2>&1 ||
  green "$made; an example run by node $(node --version); no registry for its tests"
ctest --test-dir "$build" -C package -L js --no-tests=error --output-on-failure >"$at/tests.log" 2>&1 || {
  cat "$at/tests.log"
  red "its tests fail: $at/tests.log"
}
green "$made; an example and $(grep -c ' Passed ' "$at/tests.log") tests run by node $(node --version)"
