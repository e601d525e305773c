#!/bin/sh
# build.sh BUILD [SCALAR...]: builds the modules and the npm package in BUILD/package, and packs it.
# SPDX-License-Identifier: MIT
#
# SCALAR: f32 f64 q16 q32, all unless told. Modules are in BUILD/SCALAR and go on from there. Needs Debian's clang-19
# lld-19 wasi-libc libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 libclang-rt-19-dev-wasm32 libeigen3-dev libxxhash-dev,
# cmake, node and npm. JOBS: compilers at a time. Exits 64 on other words, 69 when something is missing, 70 when a build
# fails. On stdout: each module's size and its size compressed [bytes], and the packed file's name.
set -u
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P) || exit 70
root=$(CDPATH='' cd -- "$here/../.." && pwd -P) || exit 70
fail() { status=$1; shift; echo "src/js/build.sh: $*" >&2; exit "$status"; }

[ $# -ge 1 ] || fail 64 "usage: build.sh BUILD [f32|f64|q16|q32]..."
build=$1
shift
[ $# -gt 0 ] || set -- f32 f64 q16 q32
compiler=clang++-19
command -v "$compiler" >/dev/null 2>&1 || fail 69 "no $compiler"
[ -f /usr/lib/wasm32-wasi/libc.a ] || fail 69 "no wasi-libc"
command -v npm >/dev/null 2>&1 || fail 69 "no npm"
generator=''
if command -v ninja >/dev/null 2>&1; then generator=-GNinja; fi
mkdir -p "$build" || exit 70
build=$(CDPATH='' cd -- "$build" && pwd -P) || exit 70

name_of() {  # as ISOSTEP_SCALARS has it
  case $1 in
    f32) echo float ;;
    f64) echo double ;;
    q16) echo Q16_16 ;;
    q32) echo Q32_32 ;;
    *) fail 64 "no scalar '$1': f32, f64, q16 or q32" ;;
  esac
}

# What runs between steps is compiled for size, the step itself for speed (src/js/CMakeLists.txt); the flags that exactness
# needs are the engine's own (cmake/flags.cmake). Many files at a time are compiled a third sooner.
build_module() {
  name=$(name_of "$1") || exit $?
  # shellcheck disable=SC2086
  cmake -S "$root" -B "$build/$1" $generator -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/cross.cmake" \
    -DISOSTEP_TARGET=wasm-simd -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
    "-DCMAKE_CXX_FLAGS_RELEASE=-Os -DNDEBUG -DISOSTEP_OUR_FLAGS -fvisibility=hidden -fvisibility-inlines-hidden" \
    -DISOSTEP_SCALARS="$name" -DISOSTEP_JS_MODULE=ON -DISOSTEP_C=OFF -DISOSTEP_TOOL=OFF -DISOSTEP_PROVER=OFF \
    -DISOSTEP_TESTS=OFF -DISOSTEP_EXAMPLES=OFF -DISOSTEP_INSTALL=OFF -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=15 \
    >"$build/$1.log" 2>&1 &&
    cmake --build "$build/$1" --target isostep_module --parallel "${JOBS:-2}" >>"$build/$1.log" 2>&1 ||
    { tail -n 40 "$build/$1.log" >&2; fail 70 "the module of $1 cannot be built: $build/$1.log"; }
}

# Where there is a ccache (cmake/options.cmake), the same text in another folder is the same.
export CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
package=$build/package
rm -rf "$package.new"
mkdir -p "$package.new/wasm" || exit 70
for scalar; do
  build_module "$scalar"
  module=$build/$scalar/src/js/isostep.wasm
  cp "$module" "$package.new/wasm/isostep.$scalar.wasm" || exit 70
  echo "$scalar $(wc -c <"$module") $(gzip -9c "$module" | wc -c)"
done
cp -R "$here/package.json" "$here/README.md" "$here/lib" "$here/types" "$here/example" "$root/LICENSE" "$package.new" ||
  exit 70
node "$here/generate.mjs" "$package.new" || exit 70
rm -rf "$package"
mv "$package.new" "$package" || exit 70
cd "$build" && rm -f isostep-*.tgz && npm pack --silent "$package" || fail 70 "npm pack"
