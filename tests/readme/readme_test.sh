#!/bin/sh
# The pages tell the truth: their commands run, the code they quote is the example's, the files they link to exist.
# usage: readme_test.sh REPOSITORY TOOL
set -u
. "$(dirname "$0")/../scratch.sh"
repository=$1
tool=$2
cd "$repository" || exit 1  # commands name files from here
# Pages that packages bring are theirs: `isostep package` follows them.
pages=$(find README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md STABILITY.md bench cmake include replays scalar src tests -name '*.md' ! -name '*-part.md' \
  ! -path 'src/packages/*/*' | sort)
failures=0
complain() {
  echo "readme: $1" >&2
  failures=$((failures + 1))
}

# Commands of sh blocks. demo, test, matrix and package build everything and are CI's own words; bench, lab --all and
# lab --published measure for minutes: tests/lab runs short ones.
# shellcheck disable=SC2086
commands=$(awk '/^```sh$/ {inside = 1; next} /^```$/ {inside = 0} inside' $pages | sed 's/ *#.*$//' | grep '^\./isostep ' |
  grep -v -e '^\./isostep demo$' -e '^\./isostep test$' -e '^\./isostep bench' -e '^\./isostep matrix' \
    -e '^\./isostep package' -e '^\./isostep lab --all' -e '^\./isostep lab --published')
# What they write, and the port they meet at, are this run's own; the port is none that the system hands out.
# Peers are patient: on a machine that stalls nobody has left.
commands=$(printf '%s\n' "$commands" |
  sed "s|/tmp/|'$dir'/|g; s/41873/$((20000 + $$ % 10000))/g; s/isostep peer /isostep peer --patience 600 /")
[ "$(printf '%s\n' "$commands" | wc -l)" -ge 13 ] || complain "fewer commands than expected were found to run"
background=''
while IFS= read -r command; do
  arguments=${command#./isostep }
  case $arguments in
    *\&)
      eval "\"\$tool\" ${arguments%&}" >/dev/null 2>&1 &
      background="$background $!"
      ;;
    *)
      eval "\"\$tool\" $arguments" >/dev/null 2>"$dir/said"
      status=$?
      case $status,$arguments in
        0,* | 69,bake\ *) ;;  # 69: what reads such files was not there when the tool was built
        64,*) # a build without the book's methods
          if grep 'this build leaves out' "$dir/said"; then echo "skipped: '$command'"; else complain "'$command' exits 64"; fi ;;
        *) complain "'$command' exits $status" ;;
      esac
      ;;
  esac
done <<LIST
$commands
LIST
for pid in $background; do
  wait "$pid" || complain "a command in the background exits $?"
done

# What pages name by the way: words of ./isostep, presets of CMake.
usage=$(./isostep 2>&1)
# shellcheck disable=SC2086
for word in $(grep -oh '\./isostep [a-z][a-z]*' $pages | cut -d ' ' -f 2 | sort -u); do
  case $usage in *" $word "*) ;; *) complain "'./isostep $word' does not exist" ;; esac
done
# shellcheck disable=SC2086
for preset in $(grep -oh -e '--preset [a-z][a-z]*' $pages | cut -d ' ' -f 2 | sort -u); do
  grep -Fq "\"name\": \"$preset\"" CMakePresets.json || complain "CMakePresets.json has no '$preset'"
done

# A C++, C, TypeScript or JavaScript block after the line <!-- from FILE --> is quoted: all blocks of a page from one
# file are the parts of that file between its marks, each less its first line's indentation.
quoted() { # page, file
  awk -v mark="<!-- from $2 -->" '/^```$/ {inside = 0} inside; /^```(cpp|c|ts|js)$/ {inside = last == mark} {last = $0}' "$1"
}
marked() { # file
  awk '/README: begin/ {inside = 1; indent = -1; next} /README: end/ {inside = 0}
    inside {if (indent < 0) indent = match($0, /[^ ]/); print substr($0, indent)}' "$1"
}
for page in $pages; do
  for file in $(sed -n 's/^<!-- from \(.*\) -->$/\1/p' "$page" | sort -u); do
    [ -n "$(quoted "$page" "$file")" ] || complain "$page names $file, and quotes nothing of it"
    [ "$(quoted "$page" "$file")" = "$(marked "$file")" ] || complain "the C++ of $page differs from $file"
  done
done
for file in $(grep -l 'README: begin' src/examples/*.cpp src/examples/*.c); do
  # shellcheck disable=SC2086
  grep -Fqx -e "<!-- from $file -->" $pages || complain "no page quotes the marked parts of $file"
done
[ "$(grep -c '^```cpp$' README.md)" -eq "$(grep -c '^<!-- from ' README.md)" ] ||
  complain "README.md has C++ that no example has"

# Links of every page lead to files and headings that are there. README leads to every page once; to those of a folder
# pages/ the README beside that folder does.
# shellcheck disable=SC2086
places=$(grep -o ']([^)]*)' $pages /dev/null | sed 's/](//; s/)$//' | grep -v ':http')  # lines of page:place
links=$(printf '%s\n' "$places" | sed 's/#.*//')
anchors_of() { sed -n 's/^##* //p' "$1" | tr 'A-Z ' 'a-z-' | LC_ALL=C sed 's/[^a-z0-9_-]//g'; }
while IFS=: read -r page place; do
  case $page in */*) folder=${page%/*} ;; *) folder=. ;; esac
  case $place in \#*) file=$page ;; *) file=$folder/${place%%#*} ;; esac
  [ -e "$file" ] || complain "$page links to $place, which does not exist"
  case $file,$place in
    *.md,*#*) anchors_of "$file" | grep -Fqx -e "${place#*#}" || complain "$page links to $place: no such heading" ;;
  esac
done <<LIST
$places
LIST
for page in $pages; do
  case $page in
    */pages/*) list=${page%/pages/*}/README.md link=pages/${page##*/pages/} ;;
    *) list=README.md link=$page ;;
  esac
  [ "$page" = README.md ] || [ "$(printf '%s\n' "$links" | grep -Fxc -e "$list:$link")" -eq 1 ] ||
    complain "$list does not link to $page once"
done

[ "$failures" -eq 0 ] && echo "readme: all true"
exit "$failures"
