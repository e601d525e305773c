# isostep package: makes every package of isostep, installs each where nothing else is, runs its example and compares what
# that prints with the build's own. Sourced by ./isostep, whose functions it uses; README.md here tells the rest.
# SPDX-License-Identifier: MIT

packages_here=$root/src/packages
package_usage='usage: ./isostep package [--only NAME]... [--list] [--out DIRECTORY]'

# Name, file in packages_here, what it is. In this order: later ones use what earlier ones built.
package_list() {
  cat <<'LIST'
versions|versions|the three versions go together
installed|installed|cmake --install: C++, C, Python and C# for a prefix
tarball|tarball|the sources that a build needs, and nothing else
debian|debian|libisostep, libisostep-dev, python3-isostep
vcpkg|vcpkg|an overlay port
windows|windows|a DLL for x86-64 with its import library
npm|npm|JavaScript and TypeScript: WebAssembly
unity|unity|the package that Unity's package manager takes
match|match|no package: a match between C++, C, C# and JavaScript
LIST
}
package_names() { package_list | cut -d '|' -f 1; }

read_package_words() {
  only='' listing='' out=''
  while [ $# -gt 0 ]; do
    case $1 in
      --list) listing=yes ;;
      --help | -h) printf '%s\n' "$package_usage"; exit ;;
      --only | --out)
        [ $# -gt 1 ] && [ -n "$2" ] || fail 64 "$1 wants a word; $package_usage"
        case $1 in
          --out) case $2 in /*) out=$2 ;; *) out=$PWD/$2 ;; esac ;;
          *)
            package_names | grep -Fqx -e "$2" || fail 64 "no package '$2'; there are:" $(package_names)
            only="$only $2"
            ;;
        esac
        shift
        ;;
      *) fail 64 "no option '$1'; $package_usage" ;;
    esac
    shift
  done
}

# bring_package_tools: what makes and tries packages, where it can be had; what is missing afterwards is said by its row.
bring_package_tools() {
  wanted=''
  while read -r program package; do
    have "$program" || [ -f "$program" ] || wanted="$wanted $package"
  done <<LIST
dh debhelper
dh_python3 dh-python
dpkg-buildpackage dpkg-dev
lintian lintian
mmdebstrap mmdebstrap
python3 python3
x86_64-w64-mingw32-g++-posix g++-mingw-w64-x86-64-posix
wine wine64
npm npm
chromium chromium
clang++-19 clang-19
wasm-ld-19 lld-19
/usr/lib/wasm32-wasi/libc.a wasi-libc
/usr/lib/wasm32-wasi/libc++.a libc++-19-dev-wasm32
/usr/lib/wasm32-wasi/libc++abi.a libc++abi-19-dev-wasm32
/usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a libclang-rt-19-dev-wasm32
mcs mono-mcs
mono mono-runtime
ccache ccache
LIST
  [ -n "$wanted" ] && have apt-get && [ "$(id -u)" = 0 ] && [ "${ISOSTEP_NO_INSTALL:-}" != 1 ] || return 0
  apt_get update
  known=''  # an older system lacks some, and the others are brought all the same
  for package in $wanted; do
    apt-cache show "$package" >/dev/null 2>&1 && known="$known $package"
  done
  say "apt-get install -y --no-install-recommends$known"
  # shellcheck disable=SC2086
  DEBIAN_FRONTEND=noninteractive apt_get install -y --no-install-recommends $known ||
    say "isostep: without$known some packages are left out"
}

# make_package NAME FILE: its row. The file runs by itself, with its output in a log, and exits 0, 69 with the reason
# why it is not made here as its last line, or anything else with what went wrong as its last line.
make_package() {
  say "$1 ..."
  begun=$(date +%s)
  rm -rf "$work/$1.log"
  sh "$packages_here/$2.sh" >"$work/$1.log" 2>&1
  status=$?
  last=$(tail -n 1 "$work/$1.log" | tr '\t' ' ')
  case $status in
    0) result="green: $last" ;;
    69) result="not made here: $last" ;;
    *) result="RED: $last; $work/$1.log" ;;
  esac
  printf '%s\t%s s\t%s\n' "$1" "$(($(date +%s) - begun))" "$result" >>"$rows"
  say "$1: $result"
}

package() {
  read_package_words "$@"
  if [ -n "$listing" ]; then
    package_list | awk -F '|' '{printf "%-10s %s\n", $1, $3}'
    exit
  fi
  need test
  bring_package_tools
  kind=tests  # which this build is configured for already, or as little as has the examples
  ! grep -q '^ISOSTEP_FULL_TESTS:BOOL=ON' "$build/CMakeCache.txt" 2>/dev/null || kind=full
  make_all "$kind" isostep_packaged || exit 70
  work=$build/package
  out=${out:-$work/out}
  mkdir -p "$work" "$out" || exit 70
  # What the example of every package must print: four scalars, stepped by the library that the tests have proved.
  "$build/src/examples/example_four_scalars" >"$work/hello.txt" || fail 70 "the example of the build itself fails"
  export CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros  # the same text in another folder is the same
  export ISOSTEP_ROOT="$root" ISOSTEP_BUILD="$build" ISOSTEP_WORK="$work" ISOSTEP_OUT="$out"
  rows=$work/rows
  printf 'package\ttime\tresult\n' >"$rows"
  package_list | while IFS='|' read -r name file _; do
    case " ${only:- $name} " in *" $name "*) make_package "$name" "$file" </dev/null ;; esac
  done
  awk -F '\t' '{printf "%-10s %7s  %s\n", $1, $2, $3}' "$rows"
  echo
  sh "$packages_here/sizes.sh"
  echo "in $out"
  [ -z "$only" ] || ! grep -q 'not made here' "$rows" || exit 69
  ! grep -q '	RED' "$rows"
  exit
}
