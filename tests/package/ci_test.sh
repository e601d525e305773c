#!/bin/sh
# The template of a game's continuous integration does what its page says: its workflow's own commands run here, agree,
# and see one changed digit.
# usage: ci_test.sh REPOSITORY PREFIX, where isostep is installed
set -u
. "$1/tests/scratch.sh"
template=$1/src/examples/ci
cp "$template"/* "$dir/" || exit 1
cd "$dir" || exit 1
export CMAKE_PREFIX_PATH="$2" ISOSTEP="$dir/isostep" FRAMES=60

# steps_of JOB: "name<TAB>command" for every line of its `run`s, as the workflow has them.
steps_of() {
  awk -v job="  $1:" '
    /^  [a-z]+:$/ {inside = $0 == job; block = 0}
    !inside {next}
    block && !/^          / {block = 0}
    block {print name "\t" substr($0, 11)}
    /^      - name: / {name = substr($0, 15)}
    /^        run: [^|]/ {print name "\t" substr($0, 14)}
    /^        run: \|$/ {block = 1}' determinism.yml
}
# run_job JOB BUILD: its commands but those that need the network or compile the engine.
run_job() {
  steps_of "$1" | grep -v -e '^Packages	' -e '^Engine	' | cut -f 2 |
    sed "s/\${{ matrix.build }}/$2/g; s/\${{ matrix.machine }}/here/g; s/ -DCMAKE_PREFIX_PATH=[^ ]*//" >"$dir/commands"
  sh -e "$dir/commands" >"$dir/out" 2>"$dir/err"
}
[ "$(steps_of hashes | wc -l)" -ge 8 ] && [ "$(steps_of compare | wc -l)" -eq 1 ] || fail "the workflow's steps are not read"

# Without goldens the job fails; with them, and with both builds, all agree.
run_job hashes Release && fail "a repository without goldens passes"
grep -q 'goldens/match.hashes is missing' "$dir/err" || fail "nobody is told that the goldens are missing"
mkdir goldens && cp here-Release.hashes goldens/match.hashes
[ "$(wc -l <goldens/match.hashes)" -eq 120 ] || fail "two scalars of 60 frames are not 120 hashes"
[ "$(cut -d ' ' -f 3 goldens/match.hashes | sort -u | wc -l)" -eq 120 ] || fail "the match stands still"
for build in Release Debug; do
  rm -rf build
  run_job hashes "$build" || fail "the job of $build fails"
  mkdir -p "hashes/hashes-here-$build" && mv "here-$build.hashes" "hashes/hashes-here-$build/"
done
run_job compare '' || fail "Release and Debug differ"
grep -q '^2 machines agree on 120 hashes$' "$dir/out" || fail "what was compared is not said"

# One digit of one hash; a frame that is missing; a job whose file never came.
changed=hashes/hashes-here-Debug/here-Debug.hashes
sed -i '77s/.$/x/' "$changed"
run_job compare '' && fail "a changed hash is not seen"
grep -q 'differ: line 77: ' "$dir/err" || fail "the frame that differs is not named"
head -n 119 goldens/match.hashes >"$changed"
run_job compare '' && fail "a missing frame is not seen"
grep -q 'differ: line 120: ' "$dir/err" || fail "the frame that is missing is not named"
rm -r hashes/hashes-here-Debug
run_job compare '' && fail "one file alone passes"
sh determinism.sh compare >"$dir/out" 2>"$dir/err"
[ $? -eq 64 ] || fail "missing words do not exit 64"
exit 0
