#!/bin/sh
# page_test.sh TOOL: pages of small scenes, opened in headless Chromium: what they play is what the tool ran.
# SPDX-License-Identifier: MIT
set -u
tool=$1
. "$(dirname "$0")/../scratch.sh"

browser=''
for name in chromium chromium-browser google-chrome; do
  if command -v "$name" >/dev/null 2>&1; then browser=$name; fi
done

"$tool" run S1x5 --frames 2 --html "$dir/try.html" >"$dir/out" 2>"$dir/err"
status=$?
if [ "$status" = 69 ]; then skip "$(cat "$dir/err")"; fi
[ "$status" = 0 ] || fail "run --html ends with $status: $(cat "$dir/err")"
[ -n "$browser" ] || skip "no Chromium"

# open NAME ADDRESS WORDS...: Chromium without a screen, a network or a sandbox of its own, on that page.
open() {
  name=$1 address=$2
  shift 2
  timeout 1200 "$browser" --headless --no-sandbox --disable-dev-shm-usage --use-angle=swiftshader \
    --enable-unsafe-swiftshader --host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir="$dir/profile" \
    --hide-scrollbars --window-size=800,600 --virtual-time-budget=3000 "$@" "file://$dir/$name.html#$address" \
    2>"$dir/browser.err"
}

# check NAME FRAMES HASHES...: the page itself says that it has so many frames, ends at these hashes, and drew something.
check() {
  name=$1 frames=$2
  shift 2
  open "$name" '' --dump-dom | grep -o '<pre id="check"[^<]*' >"$dir/check"
  said=$(cat "$dir/check")
  case $said in
    *"ready frames $frames last $* parted "*" errors 0") ;;
    *) fail "$name: the page says: $said; expected $frames frames and $*; $(tail -n 3 "$dir/browser.err")" ;;
  esac
  shades=$(sed 's/.* shades \([0-9]*\) .*/\1/' "$dir/check")
  [ "$shades" -ge 10 ] || fail "$name: $shades colours in the picture"
}
last_of() { tail -n 1 "$1" | cut -d ' ' -f 2; }

"$tool" run S1x5 --frames 60 --hashes "$dir/stack" --html "$dir/stack.html" >/dev/null || fail "stack"
check stack 61 "$(last_of "$dir/stack")"

# Bodies that come and go, every fourth step; two scalars.
"$tool" run mixed --frames 118 --hashes "$dir/a" --html "$dir/mixed.html" --html-every 4 --beside q32.32 >"$dir/out" ||
  fail "mixed"
"$tool" run mixed --frames 118 --scalar q32.32 --hashes "$dir/b" >/dev/null || fail "mixed in q32.32"
check mixed '31 31' "$(last_of "$dir/a") $(last_of "$dir/b")"
parted=$(sed -n 's/.*parts from it at frame \([0-9]*\),.*/\1/p' "$dir/out")
grep -q "parted ${parted:-never} " "$dir/check" || fail "mixed: the tool says '$parted': $(cat "$dir/check")"

# A hull, and nothing else that could bring colours into the picture.
cat >"$dir/gem.json" <<'END'
{"name": "gem", "gravity": [0, 0, 0], "bodies": [{"type": "dynamic", "position": [0, 0, 0], "shapes": [{"type": "hull",
 "points": [[0, 5, 8], [0, -5, 8], [0, 5, -8], [0, -5, -8], [5, 8, 0], [-5, 8, 0], [5, -8, 0], [-5, -8, 0],
            [8, 0, 5], [8, 0, -5], [-8, 0, 5], [-8, 0, -5]]}]}]}
END
"$tool" run "$dir/gem.json" --frames 2 --hashes "$dir/gem" --html "$dir/gem.html" >/dev/null || fail "gem"
check gem 3 "$(last_of "$dir/gem")"

[ "${ISOSTEP_WHOLE:-}" = 1 ] || exit 0  # a sample has bodies alone

# What acts and is no body: a boat's water, wind and four surfaces; a charge while it lasts; pieces of what breaks.
shades() { open "$1" "$2" --dump-dom | sed -n 's/.*<pre id="check".* shades \([0-9]*\) .*/\1/p'; }
# acts NAME EFFECTS FRAME: so many records are in the page, and without them the picture of that frame has fewer colours.
acts() {
  grep -q " effects $2 " "$dir/check" || fail "$1: not $2 effects: $(cat "$dir/check")"
  with=$(shades "$1" "frame=$3") without=$(shades "$1" "frame=$3&effects=0")
  [ "$with" -gt "$without" ] || fail "$1: $with colours with its effects, $without without"
}
"$tool" run sail --frames 60 --hashes "$dir/sail" --html "$dir/sail.html" >/dev/null || fail "sail"
check sail 61 "$(last_of "$dir/sail")"
acts sail 6 60
"$tool" run explosion --frames 80 --hashes "$dir/charge" --html "$dir/charge.html" >/dev/null || fail "explosion"
check charge 81 "$(last_of "$dir/charge")"
acts charge 1 78
"$tool" run fracture --frames 60 --hashes "$dir/pieces" --html "$dir/pieces.html" >/dev/null || fail "fracture"
check pieces 61 "$(last_of "$dir/pieces")"
seen() { open pieces "frame=$1" --dump-dom | sed -n 's/.*>\([0-9]*\) bodies, .*/\1/p'; }
whole=$(seen 0) broken=$(seen 60)
[ "$whole" = 2 ] && [ "$broken" -ge 9 ] || fail "fracture: ${whole:-no} bodies, then ${broken:-none}"

# Particles, and a picture.
"$tool" run cloth --frames 60 --hashes "$dir/cloth" --html "$dir/cloth.html" >/dev/null || fail "cloth"
check cloth 61 "$(last_of "$dir/cloth")"
open cloth 'frame=60' --screenshot="$dir/cloth.png" >/dev/null
bytes=$(wc -c <"$dir/cloth.png")
[ "$bytes" -ge 20000 ] || fail "cloth: a picture of $bytes bytes is blank"
