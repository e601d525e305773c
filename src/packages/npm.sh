#!/bin/sh
# The npm package: built by src/js/build.sh, installed into an empty project, an example run by node.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
[ -f "$root/src/js/build.sh" ] || not_here "src/js is not in this copy"
have npm && have node || not_here "no npm"
at=$work/npm
mkdir -p "$at" || exit 70
JOBS=${ISOSTEP_PACKAGE_JOBS:-$(getconf _NPROCESSORS_ONLN)} sh "$root/src/js/build.sh" "$at/build" || {
  case $? in
    69) not_here "$(tail -n 1 "$work/npm.log")" ;;
    *) red "src/js/build.sh fails" ;;
  esac
}
file=$(ls "$at"/build/isostep-*.tgz) || red "src/js/build.sh packs nothing"
cp "$file" "$out/" || exit 70
rm -rf "$at/project" && mkdir "$at/project" && cd "$at/project" || exit 70
echo '{"name": "consumer", "private": true, "type": "module"}' >package.json
npm install --silent --no-audit --no-fund --offline "$file" || red "npm install fails"
cp "$packages/npm/four_scalars.mjs" . || exit 70
prints_goldens node four_scalars.mjs
green "$(basename "$file"), $(du -h "$file" | cut -f 1); an example run by node $(node --version)"
