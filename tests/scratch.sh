# What tests in sh share: a folder, `dir`, that goes away; failing with what was printed; skipping. Sourced.
# SPDX-License-Identifier: MIT
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# fail WHY: the files that commands printed into come after it.
fail() {
  echo "$1" >&2
  for printed in "$dir"/out "$dir"/err "$dir"/*.err; do
    [ ! -f "$printed" ] || cat "$printed" >&2
  done
  exit 1
}
skip() {
  echo "skipped: $1"
  exit 77
}
