#!/bin/sh
# The C# numbers have the library's bits: compiled as they are, and with checked arithmetic, which must not throw.
# usage: numbers_test.sh REPOSITORY PACKAGE NUMBER_VECTORS
set -u
. "$1/tests/scratch.sh"
here=$1/tests/csharp
"$3" "$dir/vectors" || fail "the vectors cannot be written"
number() { sed "s/@NAME@/$1/g; s/@RAW@/$2/g" "$here/NumberOperations.cs.in" >"$dir/$1Operations.cs"; }
family() {
  sed "s/@NS@/$1/g; s/@S@/$2/g; s/@U@/$2Unit/g; s/@RAW@/$3/g" "$here/FamilyOperations.cs.in" >"$dir/$1Operations.cs"
}
number Q16 int
number Q16Unit int
number Q32 long
number Q32Unit long
family Fixed16 Q16 int
family Fixed32 Q32 long
# The numbers alone: they need nothing else of the package.
runtime=$2/Runtime
sources=$(echo "$runtime"/Numbers/*.cs)
for part in Vec3 UnitVec3 Vec3Mixed Quat; do
  sources="$sources $runtime/Fixed16/$part.cs $runtime/Fixed32/$part.cs"
done
for checked in - +; do
  # shellcheck disable=SC2086
  mcs -warnaserror -optimize+ -checked$checked -out:"$dir/vectors.exe" $sources "$here/NumberVectors.cs" \
    "$dir"/*Operations.cs >"$dir/out" 2>&1 || fail "the numbers do not compile"
  mono "$dir/vectors.exe" "$dir/vectors" >"$dir/out" 2>"$dir/err" || fail "the numbers differ (checked$checked)"
  cat "$dir/out"
done
