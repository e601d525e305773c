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

# Tests take samples; with --full they are told to try the whole.
mkdir "$dir/bin"
printf '#!/bin/sh\n' >"$dir/bin/cmake"
printf '#!/bin/sh\necho "whole: ${ISOSTEP_WHOLE:-no}"\n' >"$dir/bin/ctest"
chmod +x "$dir/bin/cmake" "$dir/bin/ctest"
for word in no 1; do
  full=$([ "$word" = no ] || echo --full)
  # shellcheck disable=SC2086
  said=$(unset ISOSTEP_WHOLE; PATH="$dir/bin:$PATH" ISOSTEP_BUILD_DIR="$dir/tests" "$launcher" test $full 2>"$dir/err")
  status=$?
  [ "$status" = 69 ] && continue  # a compiler or a library that --full asks for is missing here
  [ "$said" = "whole: $word" ] || fail "test $full ends with $status and says '$said'"
done

# Where a compiler finds no library, as root: words that build for minutes ask apt-get for what they need, others name it.
for stub in 'c++ exit 1' 'id echo 0' 'apt-get echo "$*" >>"$APT_LOG"'; do
  printf '#!/bin/sh\n%s\n' "${stub#* }" >"$dir/bin/${stub%% *}"
  chmod +x "$dir/bin/${stub%% *}"
done
for word in demo lab matrix bench\ scenes run; do
  : >"$dir/apt"
  # shellcheck disable=SC2086
  (unset ISOSTEP_NO_INSTALL; PATH="$dir/bin:$PATH" CXX=c++ APT_LOG="$dir/apt" ISOSTEP_BUILD_DIR="$dir/bare" "$launcher" $word) \
    >/dev/null 2>"$dir/err"
  [ $? -eq 69 ] || fail "'$word' without libraries does not exit 69"
  grep -q libcli11-dev "$dir/err" || fail "'$word' does not name what is missing"
  case $word,$(cat "$dir/apt") in
    run,) ;;
    run,*) fail "'run' installs" ;;
    *libcli11-dev*) ;;
    *) fail "'$word' does not ask for what is missing" ;;
  esac
done

# What was not printed was not said: help as well.
[ -c /dev/full ] || exit 0
for word in --help --version scenes; do
  "$2" "$word" >/dev/full 2>"$dir/err"
  [ $? -eq 74 ] || fail "'$word' into a full disk does not exit 74"
done
