#!/bin/sh
# Numbers on pages are the code's: limits, defaults, presets, lengths of lists. A line of `numbers` names a page, its
# words with an @ where the number stands, and the number, which is read from the source. Every number is then made
# false in a copy of its page, and has to be found.
# SPDX-License-Identifier: MIT
# usage: numbers_test.sh REPOSITORY
# shellcheck disable=SC1091,SC2016,SC2154  # `constants` assigns
set -u
. "$(dirname "$0")/../scratch.sh"
cd "$1" || exit 1

# constants FILE...: their integer constants become variables of the same names.
constants() {
  eval "$(sed -n 's/^ *\(inline \)\{0,1\}constexpr [A-Za-z0-9_:]* \(k[A-Za-z0-9]* = [0-9(k][0-9A-Za-z()*+<> -]*\);.*/\2/p' \
    "$@" | sed 's/\([0-9]\)u/\1/g; s/ = \(.*\)/=$((\1))/')"
}
# value FILE NAME: what FILE initialises NAME with; of S(0.25) the number in the parentheses.
value() { sed -n "s/.*[ &*]$2 = \([A-Za-z<>]*(\)\{0,1\}\([0-9.]*\)[);,> ].*/\2/p" "$1" | head -n 1; }
# most FIELD: of SessionConfig, as the refusal says.
most() { sed -n "s/.*\"$1: [0-9]* to \([0-9]*\)[ \"].*/\1/p" src/isostep/session/config.cpp; }
# rows FILE PATTERN: the lines of FILE that match.
rows() { grep -c -e "$2" "$1"; }
# power N: as pages write a power of two.
power() {
  exponent=0
  while [ $exponent -lt 62 ] && [ $((1 << exponent)) -lt "$1" ]; do exponent=$((exponent + 1)); done
  [ $((1 << exponent)) -ne "$1" ] || echo "2^$exponent"
}
says() { printf '%s\t%s\t%s\n' "$1" "$2" "$3"; } # page, words, number

joints=$(rows include/isostep/dynamics/joints/joint_type.hpp '^  X([a-z_]*, [A-Za-z]*)')
session=include/isostep/session
world=include/isostep/dynamics/settings.hpp
state=include/isostep/state
substeps=$(value $world substeps)
scalars=$(sed -n 's/^#define ISO_FOR_EACH_SCALAR(X)//p' include/isostep/core/instantiate.hpp | grep -o 'ISO_IF_' | wc -l)
targets=$(grep -v '^#' tests/matrix/targets.tsv | grep -vc '^target')
constants $session/timeline/frame.hpp $session/timeline/input_codec.hpp \
  $session/config.hpp $session/protocol/message.hpp $session/observers/large_order.hpp $world \
  $state/replay_header.hpp $state/replay_format.hpp $state/command_log.hpp $state/frame.hpp src/isostep/state/replay_writer.cpp
# preset_GENRE_FIELD of every field that preset.cpp sets.
eval "$(awk '/case Genre::/ {genre = $2; gsub(/Genre::|:/, "", genre)}
  /config\..* = [0-9]+;/ {n = split($0, parts, " = "); for (i = 1; i < n; ++i) {
    field = parts[i]; sub(/ *config\./, "", field); print "preset_" genre "_" field "=" parts[n] + 0}}' src/isostep/session/preset.cpp)"

numbers() {
  says README.md '| joints | @ types; limits' "$joints"
  says README.md '| joints | @ types, couplings' "$joints"
  says README.md 'spectators; up to @ players' "$kMaxPlayers"
  says README.md 'the check at start; @ example programs' "$(grep -l '^int main' src/examples/*.c src/examples/*.cpp | wc -l)"
  says README.md '| yes, @ targets tested' "$targets"


  page=replays/README.md
  says $page 'format, version @, complete' "$kReplayMajor.$kReplayMinor"
  says $page '## Preamble, @ bytes' "$kReplayPreambleSize"
  says $page 'length of the preamble, @ |' "$kReplayPreambleSize"
  says $page 'major version, @. Another' "$kReplayMajor"
  says $page 'minor version, @. A later' "$kReplayMinor"
  says $page 'HEAD @, INIT' "$kReplayHeadCap"
  says $page 'INIT @ + 8,' "$(power "$kReplayStateCap")"
  says $page 'INPT @, HASH' "$(power "$kReplayInputCap")"
  says $page 'HASH @, KEYF' "$((kBlockStart + 8 * kReplayBlockFrames))"
  says $page 'KEYF @ + 16,' "$(power "$kReplayStateCap")"
  says $page 'unknown types @.' "$(power "$kReplayUnknownCap")"
  says $page 'number of fields, at most @;' "$kReplayFieldCap"
  says $page 'key of 1 to @ characters' "$kReplayKeyCap"
  says $page 'value of 1 to @ characters' "$kReplayValueCap"
  says $page 'decimal, at most @; absent: 0' "$(power "$kLastFrame")"
  says $page 'count of frames, 1 to @:' "$kReplayBlockFrames"
  says $page 'length, at most @, and as many bytes of input' "$(power "$kReplayFrameInputCap")"
  says $page 'may have at most @ steps (`kFrameStepCap`)' "$kFrameStepCap"
  says $page 'stepped it more than @ times' "$kFrameStepCap"

  page=src/csharp/README.md
  says $page 'worlds in @ scalars' "$scalars"
  says $page '`UdpTransport.Listen` and `Connect`, @ bytes' "$(sed -n 's/.*PacketKey = .*, \([0-9]*\)>;/\1/p' src/transport/line_guard.hpp)"

  page=include/isostep/dynamics/pages/friction.md
  says $page 'or faster, @ m/s by default' "$(value $world restitution_threshold)"
  says $page 'if it slipped faster than @ m/s' "$(value include/isostep/dynamics/contact_friction.hpp kSlidingSpeed)"
  page=include/isostep/geometry/README.md
  says $page '`hz` times sub-steps is at most @.' "$kMaxRate"
  says $page 'that is by @ rad/s with the default' "$(($(value $world hz) * substeps))"
  says $page 'default settings and by @ with `pgs`' "$(value $world hz)"

  says $session/README.md 'A match has up to @ players' "$kMaxPlayers"
  page=$session/pages/joining.md
  says $page '**Up to @ players** (`kMaxPlayers`' "$kMaxPlayers"
  says $page '`credential` of up to @ bytes' "$kCredentialCap"
  page=$session/pages/inputs.md
  says $page 'An input takes at most @ bytes' "$kInputCap"
  says $page 'such an order of up to @ KB' "$((kLargeOrderCap >> 10))"
  says $page 'travels in pieces of @ bytes' "$(value $session/observers/large_order.hpp kPiece)"
  page=$session/pages/transports.md
  says $page 'own datagrams have at most @ bytes' "$kDatagramCap"
  says $page 'its messages at most @ KiB' "$((kReliableCap >> 10))"
  page=$session/pages/settings.md
  for field in players local_players hz window delay least_delay most_delay deadline kept silence patience exclusion \
    reservation max_peers max_strangers history most_replayed migration broadcast_delay; do
    says $page "| \`$field\` | @ " "$(value $session/config.hpp $field)"
  done
  says $page '| `most_delay` | 20 frames | 0 to @ |' "$kMostDelay"
  says $page '| `deadline` | 0 frames | 0 to @ |' "$kMostDeadline"
  says $page '| `players` | 2 | 1 to @ |' "$(most players)"
  says $page '| `hz` | 60 | 1 to @ |' "$(most hz)"
  says $page '| `window` | 8 frames | 0 to @ |' "$(most window)"
  says $page '| `max_peers` | 16 | 1 to @ |' "$(most max_peers)"
  says $page '| `max_strangers` | 48 | 0 to @ |' "$(most max_strangers)"
  page=$session/CHOOSING.md
  says $page '| fighting, 2 players | rollback | @ |' "$preset_fighting_least_delay to $preset_fighting_most_delay frames"
  says $page 'to 4 frames | @ | one of the two' "$preset_fighting_window | $preset_fighting_deadline"
  says $page '| platform brawl, 2 to 4 | rollback | @ | the player' \
    "$preset_brawler_least_delay to $preset_brawler_most_delay | $preset_brawler_window | $preset_brawler_deadline"
  says $page '| racing, 2 to 8 | rollback | @ | as above |' \
    "$preset_racing_least_delay to $preset_racing_most_delay | $preset_racing_window | $preset_racing_deadline"
  says $page '| real-time strategy, 2 to 8 | lockstep | @ | as above;' \
    "$preset_strategy_least_delay to $preset_strategy_most_delay | none | $preset_strategy_deadline"
  says $page '| physics sandbox, 2 to 4 | rollback | @ | none |' \
    "$preset_sandbox_least_delay to $preset_sandbox_most_delay | $preset_sandbox_window"

  says bench/pages/peers.md '| isostep | the defaults: @ sub-steps' "$substeps"
  says bench/pages/particles.md 'the default @ Hz' "$(value include/isostep/particles/settings.hpp hz)"
  says bench/pages/particles.md 'Hz with @ sub-steps' "$(value include/isostep/particles/settings.hpp substeps)"
  says bench/pages/sessions.md 'A session keeps @ states' "$(value $session/config.hpp kept)"
}

numbers >"$dir/numbers" || exit 1
awk -F '\t' '
BEGIN {
  count = split("one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen " \
    "seventeen eighteen nineteen twenty", names, " ")
  for (i = 1; i <= count; ++i) word[i] = names[i]
}
function text_of(page,   line) {
  if (page in text) return text[page]
  while ((getline line < page) > 0) text[page] = text[page] " " line
  gsub(/ +/, " ", text[page])
  return text[page]
}
# What stands for the number in a text: the number, or the first other thing.
function said(all, before, after, number,   at, end, found) {
  found = "nothing"
  while ((at = index(all, before)) > 0) {
    all = substr(all, at + length(before))
    end = index(substr(all, 1, 32 + length(after)), after)
    if (end == 0) continue
    found = substr(all, 1, end - 1)
    if (found != number && found != word[number]) return found
    found = number
  }
  return found
}
# The text with its number, a digit or a word, followed by a digit.
function falsified(all, before, after,   at) {
  at = index(all, before) + length(before)
  at += index(substr(all, at), after) - 1
  return substr(all, 1, at - 1) "1" substr(all, at)
}
function complain(what) {
  print "readme: " $1 ", \"" $2 "\": " what > "/dev/stderr"
  bad = 1
}
{
  hole = index($2, "@")
  before = substr($2, 1, hole - 1)
  after = substr($2, hole + 1)
  all = text_of($1)
  found = said(all, before, after, $3)
  if ($3 == "") complain("its number was not found in the code")
  else if (found != $3) complain("the page says " found ", the code " $3)
  else if (said(falsified(all, before, after), before, after, $3) == $3) complain("a false number is not found")
}
END {
  if (NR < 60) complain("fewer numbers than expected were compared")
  if (!bad) print "readme: " NR " numbers as in the code"
  exit bad
}' "$dir/numbers"
