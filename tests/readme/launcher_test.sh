#!/bin/sh
# ./isostep hands the tool's commands on, and refuses other words before it builds anything.
# usage: launcher_test.sh REPOSITORY TOOL
set -u
. "$1/tests/scratch.sh"
launcher=$1/isostep
export ISOSTEP_BUILD_DIR="$dir/build" ISOSTEP_NO_INSTALL=1

usage=$("$launcher" 2>&1)
[ $? -eq 64 ] || fail "without a word it does not exit 64"
for word in tets ru 'run verify' '*' "it's"; do
  "$launcher" "$word" 2>"$dir/err"
  [ $? -eq 64 ] || fail "'$word' does not exit 64"
  grep -Fq "no command '$word'; usage: ./isostep demo | " "$dir/err" || fail "'$word' is refused in other words"
done
[ ! -e "$dir/build" ] || fail "something was built for a word that does not exist"

# A tool that is newer than every source, and says what it is asked.
mkdir -p "$dir/build/src/tool"
printf '#!/bin/sh\necho "asked: $*"\n' >"$dir/build/src/tool/isostep"
chmod +x "$dir/build/src/tool/isostep"
: >"$dir/build/.built"
commands=$("$2" --help | awk 'tolower($0) ~ /^subcommands:/ {inside = 1; next} inside && /^  [a-z]/ {print $1}')
[ "$(printf '%s\n' "$commands" | wc -l)" -ge 8 ] || fail "--help lists fewer commands than expected"
for command in $commands --version; do
  case $("$launcher" "$command" of-the-test 2>"$dir/err") in
    "asked: $command "*of-the-test) ;;
    *) fail "'$command' does not reach the tool" ;;
  esac
  case $command,$usage in
    --*) ;;
    *,*" $command "*) ;;
    *) fail "the usage does not name '$command'" ;;
  esac
done

# What was not printed was not said: help as well.
[ -c /dev/full ] || exit 0
for word in --help --version scenes; do
  "$2" "$word" >/dev/full 2>"$dir/err"
  [ $? -eq 74 ] || fail "'$word' into a full disk does not exit 74"
done
