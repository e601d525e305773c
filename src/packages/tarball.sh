#!/bin/sh
# The sources as one file, and the example built from nothing but what is in it.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
have git && git -C "$root" rev-parse HEAD >/dev/null 2>&1 || not_here "no git repository: the sources are what it lists"
name=isostep-$version
# With what is changed and not committed, as `git stash create` puts it into a commit that nobody sees.
commit=$(git -C "$root" stash create)
git -C "$root" archive --format=tar --prefix="$name/" "${commit:-HEAD}" | gzip -9n >"$out/$name.tar.gz" || exit 70

# The Debian packages go on in this folder: what was compiled is not compiled again.
at=$work/sources
rm -rf "$at/$name" && mkdir -p "$at" || exit 70
tar -xzf "$out/$name.tar.gz" -C "$at" || red "the tarball is not read"
cd "$at/$name" || exit 70
export CCACHE_BASEDIR="$PWD"
generator=''
if have ninja; then generator=-GNinja; fi
# shellcheck disable=SC2086
cmake -S . -B build/release $generator -DCMAKE_BUILD_TYPE=Release -DISOSTEP_TOOL=OFF -DISOSTEP_PROVER=OFF \
  -DISOSTEP_TESTS=OFF -DISOSTEP_EXAMPLES=ON -DISOSTEP_SEALED=OFF || red "the sources do not configure"
cmake --build build/release --parallel "$(getconf _NPROCESSORS_ONLN)" --target example_four_scalars example_four_scalars_c ||
  red "the sources do not build"
prints_goldens build/release/src/examples/example_four_scalars
prints_goldens build/release/src/examples/example_four_scalars_c
green "$name.tar.gz, $(du -h "$out/$name.tar.gz" | cut -f 1), builds the example"
