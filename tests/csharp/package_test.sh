#!/bin/sh
# The Unity package: every file has a meta of its own, its tests and its sample run, and its page tells the truth.
# usage: package_test.sh REPOSITORY PACKAGE LIBISOSTEP ISOSTEP_CSHARP
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
assembly "$2" "$3"
package=$2
run() { mono "$dir/$1" >"$dir/out" 2>"$dir/err" || fail "$1 fails"; }

# A copy with a library in it, as the target isostep_unity_package makes.
mkdir -p "$dir/copy" && cp -R "$package" "$dir/copy/package" || fail "no copy"
copy=$dir/copy/package
mkdir -p "$copy/Runtime/Plugins/linux-x86_64" && cp "$3" "$copy/Runtime/Plugins/linux-x86_64/libisostep.so"
"$4" metas "$copy" >"$dir/out" 2>"$dir/err" || fail "the metas cannot be written"
grep -q 'Standalone: Linux64' "$copy/Runtime/Plugins/linux-x86_64/libisostep.so.meta" || fail "the library has no platform"
bare=$(find "$copy" -mindepth 1 ! -name '*.meta' ! -path '*/Documentation~*' ! -name 'Samples~' |
  while read -r asset; do [ -f "$asset.meta" ] || echo "$asset"; done)
[ -z "$bare" ] || fail "no meta: $bare"
guids=$(find "$copy" -name '*.meta' -exec sed -n 's/^guid: //p' {} +)
[ "$(echo "$guids" | sort -u | wc -l)" -eq "$(find "$copy" -name '*.meta' | wc -l)" ] || fail "two metas have one GUID"
echo "$guids" | grep -vqx '[0-9a-f]\{32\}' && fail "a GUID is none"
for json in "$package/package.json" $(find "$package" -name '*.asmdef'); do
  "${PYTHON:-python3}" -c 'import json, sys; json.load(open(sys.argv[1]))' "$json" 2>"$dir/err" || fail "$json is no JSON"
done

mcs -warnaserror -r:"$dir/Isostep.dll" -out:"$dir/tests.exe" "$package/Tests/MachineTests.cs" "$1/tests/csharp/NUnit.cs" \
  >"$dir/out" 2>&1 || fail "the package's tests do not compile"
run tests.exe
cat "$dir/out"
mcs -warnaserror -r:"$dir/Isostep.dll" -out:"$dir/sample.exe" "$package"/Samples~/TwoPucks/*.cs >"$dir/out" 2>&1 ||
  fail "the sample does not compile"
run sample.exe
cat "$dir/out"

# The C# blocks of the page are one program, which prints what their comments say.
page=$1/src/csharp/README.md
awk '/^```$/ {inside = 0} inside; /^```csharp$/ {inside = 1}' "$page" >"$dir/blocks"
{
  grep '^using [A-Za-z.0-9]*;' "$dir/blocks" | sort -u
  echo 'internal static class Page { private static void Main() {'
  grep -v '^using [A-Za-z.0-9]*;' "$dir/blocks"
  echo '} }'
} >"$dir/Page.cs"
mcs -r:"$dir/Isostep.dll" -out:"$dir/page.exe" "$dir/Page.cs" >"$dir/out" 2>&1 || fail "the page's blocks do not compile"
run page.exe
sed -n 's|.*// prints \(.*\)$|\1|p' "$dir/blocks" >"$dir/expected"
[ "$(wc -l <"$dir/expected")" -ge 6 ] || fail "the page's blocks print less than they should"
cmp "$dir/out" "$dir/expected" || fail "the page's blocks print something else"
# Its commands, in a folder of their own.
commands=$(awk '/^```$/ {inside = 0} inside; /^```sh$/ {inside = 1}' "$page")
[ -n "$commands" ] || fail "the page has no commands"
mkdir "$dir/game" && cp "$dir/Page.cs" "$dir/game/Game.cs" && ln -s "$package" "$dir/game/package" &&
  ln -s "$dir" "$dir/game/lib" || fail "no folder for the page's commands"
(cd "$dir/game" && sh -ec "$commands") >"$dir/out" 2>"$dir/err" || fail "the page's commands fail"
cmp "$dir/out" "$dir/expected" || fail "the page's commands print something else"
echo "the page is true"
