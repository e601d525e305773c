#!/bin/sh
# Draws bench/charts/motion.png: a frame of S4s in float beside Q32.32, as `isostep run --html` plays it in a browser.
# usage: motion.sh [FRAME]. Needs npm while the tool is built, and Chromium.
# SPDX-License-Identifier: MIT
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 70
frame=${1:-100}
dir=$(mktemp -d) || exit 70
trap 'rm -rf "$dir"' EXIT

browser=''
for name in chromium chromium-browser google-chrome; do
  if command -v "$name" >/dev/null 2>&1; then browser=$name; fi
done
if [ -z "$browser" ]; then
  echo "motion.sh: no Chromium here: apt-get install chromium" >&2
  exit 69
fi
"$root/isostep" run S4s --beside q32.32 --html "$dir/motion.html" || exit $?
"$browser" --headless --no-sandbox --disable-dev-shm-usage --use-angle=swiftshader --enable-unsafe-swiftshader \
  --user-data-dir="$dir/profile" --hide-scrollbars --window-size=1200,640 --virtual-time-budget=3000 \
  --screenshot="$root/bench/charts/motion.png" "file://$dir/motion.html#frame=$frame&zoom=0.85" 2>"$dir/err" ||
  { cat "$dir/err" >&2; exit 70; }
echo "drawn: bench/charts/motion.png, $(wc -c <"$root/bench/charts/motion.png") bytes"
