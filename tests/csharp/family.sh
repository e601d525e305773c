# Expands templates for families: sourced.
# SPDX-License-Identifier: MIT

# hello NS S PREFIX FROM TO OTHER OTHER_PREFIX >FILE
family_words() {
  sed "s/@NS@/$1/g; s/@S@/$2/g; s/@P@/$3/g; s/@FROM@/$4/g; s/@TO@/$5/g; s/@OTHER@/$6/g; s/@OTHER_P@/$7/g"
}
# each_family TEMPLATE NAME: $dir/NAME<family>.cs of all four.
each_family() {
  family_words F32 float f32 '(float)' 'hit.Point.Y' F64 f64 <"$1" >"$dir/$2F32.cs"
  family_words F64 double f64 '(double)' 'hit.Point.Y' Fixed16 q16 <"$1" >"$dir/$2F64.cs"
  family_words Fixed16 Q16 q16 'Q16.FromDouble' 'hit.Point.Y.ToDouble()' Fixed32 q32 <"$1" >"$dir/$2Fixed16.cs"
  family_words Fixed32 Q32 q32 'Q32.FromDouble' 'hit.Point.Y.ToDouble()' F32 f32 <"$1" >"$dir/$2Fixed32.cs"
}
# assembly PACKAGE LIBRARY: $dir/Isostep.dll, with the native library beside it.
assembly() {
  # shellcheck disable=SC2046
  mcs -warnaserror -unsafe -optimize+ -target:library -out:"$dir/Isostep.dll" \
    $(find "$1/Runtime" -name '*.cs') >"$dir/out" 2>&1 || fail "the assembly does not compile"
  cp "$2" "$dir/libisostep.so" || fail "no $2"
  export LD_LIBRARY_PATH="$dir"
}
# puck_client REPOSITORY PACKAGE LIBRARY: $dir/client.exe, a client of tests/match.
puck_client() {
  assembly "$2" "$3"
  each_family "$1/tests/csharp/Pucks.cs.in" Pucks
  mcs -warnaserror -unsafe -optimize+ -r:"$dir/Isostep.dll" -out:"$dir/client.exe" "$1/tests/csharp/PuckClient.cs" \
    "$dir"/Pucks*.cs >"$dir/out" 2>&1 || fail "the game does not compile"
}
