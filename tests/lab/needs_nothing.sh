# A page that opens without a network: nothing in it is fetched, run or embedded. Sourced.
# SPDX-License-Identifier: MIT

# needs_nothing PAGE: a reference begins with # or stays within the page.
needs_nothing() {
  grep -Eioq "<(script|link|iframe|object|embed|img|base|meta[^>]*refresh)|@import|url\([\"']?[^#\"')]" "$1" &&
    fail "the page wants a network or a script"
  grep -Eio "(src|srcset|href|action|data)=[\"']?[^#\"' >]" "$1" >"$dir/out" && fail "the page refers to something else"
  return 0
}
