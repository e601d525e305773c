#!/bin/sh
# README tells the truth: its commands run, its code is the example's, the files it links to exist.
# usage: readme_test.sh REPOSITORY TOOL
set -u
. "$(dirname "$0")/../scratch.sh"
repository=$1
tool=$2
readme=$repository/README.md
cd "$repository" || exit 1  # README's paths are the repository's
failures=0
complain() {
  echo "README: $1" >&2
  failures=$((failures + 1))
}

# Commands of sh blocks. demo, test and matrix build everything and are CI's own words; bench measures for minutes.
commands=$(awk '/^```sh$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$readme" | sed 's/ *#.*$//' | grep '^\./isostep ' |
  grep -v -e '^\./isostep demo$' -e '^\./isostep test$' -e '^\./isostep bench' -e '^\./isostep matrix')
# What they write, and the port they meet at, are this run's own; the port is none that the system hands out.
# Peers are patient: on a machine that stalls nobody has left.
commands=$(printf '%s\n' "$commands" |
  sed "s|/tmp/|'$dir'/|g; s/41873/$((20000 + $$ % 10000))/g; s/isostep peer /isostep peer --patience 600 /")
[ "$(printf '%s\n' "$commands" | wc -l)" -ge 5 ] || complain "fewer commands than expected were found to run"
background=''
while IFS= read -r command; do
  arguments=${command#./isostep }
  case $arguments in
    *\&)
      eval "\"\$tool\" ${arguments%&}" >/dev/null 2>&1 &
      background="$background $!"
      ;;
    *) eval "\"\$tool\" $arguments" >/dev/null 2>&1 || complain "'$command' exits $?" ;;
  esac
done <<LIST
$commands
LIST
for pid in $background; do
  wait "$pid" || complain "a command in the background exits $?"
done

# The C++ blocks are the parts of the examples between their marks, each less its first line's indentation.
quoted=$(awk '/^```cpp$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$readme")
shown=$(cd "$repository/src/examples" && awk '/README: begin/ {inside = 1; indent = -1; next} /README: end/ {inside = 0}
  inside {if (indent < 0) indent = match($0, /[^ ]/); print substr($0, indent)}' hello.cpp lockstep_game.cpp cloth.cpp selfcheck.cpp)
[ "$quoted" = "$shown" ] || complain "the C++ blocks differ from src/examples/hello.cpp, lockstep_game.cpp, cloth.cpp and selfcheck.cpp"

# Links of every page lead to files that are there.
links_of() { grep -o ']([^)#]*)' "$1" | sed 's/^](//; s/)$//' | grep -v '^http'; }
for page in "$readme" $(find "$repository/include" "$repository/scalar" "$repository/src" "$repository/bench" -name '*.md'); do
  for link in $(links_of "$page"); do
    [ -e "$(dirname "$page")/$link" ] || complain "${page#"$repository"/} links to $link, which does not exist"
  done
done

[ "$failures" -eq 0 ] && echo "README: all true"
exit "$failures"
