# The result: one row a target, as text and as Markdown. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

# write_row CELLS...: of a loaded target, whole or not at all.
write_row() {
  (
    IFS=$tab
    printf '%s\n' "$*"
  ) >"$at/row.part" && mv "$at/row.part" "$at/row"
}

table_head=$(printf '%s\t' target compiler flags scalars recordings frames snapshots gate build run)result

# all_rows NAMES...: those of the targets, in their order; what was never begun has one too.
all_rows() {
  printf '%s\n' "$table_head"
  for name in "$@"; do
    cat "$matrix/$name/row" 2>/dev/null || printf '%s\t-\t-\t-\t-\t-\t-\t-\t-\t-\tRED: it ended without a row\n' "$name"
  done
}

# The last line: sums, and how long everything took. Controls prove nothing of the library: they count by themselves.
summary() {
  all_rows "$@" | awk -F '\t' -v seconds="$(($(date +%s) - begun))" -v targets="$(echo $targets | wc -w)" '
    NR > 1 {
      if ($11 ~ /^RED/) red++
      else if ($11 ~ /not run here/) idle++
      else if (NR - 1 > targets) controls++
      else green++
      if (NR - 1 <= targets) {recordings += $5; frames += $6; snapshots += $7}
    }
    END {
      printf "%d green, %d red, %d not run here: ", green, red, idle
      printf "%d recordings, %d frames, %d snapshots taken over", recordings, frames, snapshots
      printf "; %d controls as they must be; ", controls
      printf "in %d min %d s\n", seconds / 60, seconds % 60
    }'
}

# what_was_run: date, machine, behaviour.
what_was_run() {
  printf '%s, %s, behaviour %s\n' "$(date -u +%Y-%m-%d)" "$(uname -srm)" "$(behaviour)"
}
behaviour() { "$reference_prover" about 2>/dev/null | awk -F '\t' '$1 == "behaviour" {print $2}'; }

# aligned: lines of cells between tabs, as columns; numbers stand to the right.
aligned() {
  awk -F '\t' '
    {for (i = 1; i <= NF; ++i) {cell[NR, i] = $i; if (length($i) > width[i]) width[i] = length($i)}}
    END {
      for (r = 1; r <= NR; ++r) {
        line = ""
        for (i = 1; i < NF; ++i) {
          left = cell[r, i] ~ /^[0-9]+( s)?$/ ? "" : "-"
          line = line sprintf("%" left width[i] "s  ", cell[r, i])
        }
        print line cell[r, NF]
      }
    }'
}

print_table() {
  what_was_run
  all_rows "$@" | aligned
  for name in "$@"; do
    [ ! -s "$matrix/$name/because" ] || cat "$matrix/$name/because"
  done
  summary "$@"
}

print_markdown() {
  what_was_run
  echo
  all_rows "$@" | awk -F '\t' '
    {
      line = "|"
      for (i = 1; i <= NF; ++i) line = line " " $i " |"
      print line
    }
    NR == 1 {print "|---|---|---|---|--:|--:|--:|---|--:|--:|---|"}'
  echo
  summary "$@"
}

# find_marks: <!-- matrix --> and <!-- /matrix -->, between which the table belongs, as the numbers of their lines in
# `page`: one of each, in this order, for of others nobody knows which text is the old table.
find_marks() {
  opening=$(sed -n '/^<!-- matrix -->$/=' "$page") && closing=$(sed -n '/^<!-- \/matrix -->$/=' "$page") || return 1
  case ${opening:-x}${closing:-x} in *[!0-9]*) return 1 ;; esac
  [ "$opening" -lt "$closing" ]
}

# takes_table: the file of --markdown is new, empty, or has the marks, and one that takes its place can be made beside
# it. Leaves `page`, what a link leads to, and `beside`; else why not, in `reason`.
takes_table() {
  page=$(readlink -f "$markdown") || page=$markdown
  beside=$page.$$.part
  reason='no file, or none that can be read and written'
  if [ -e "$page" ]; then [ -f "$page" ] && [ -r "$page" ] && [ -w "$page" ] || return 1; fi
  case $markdown in */) return 1 ;; esac
  reason='it has text, and not one <!-- matrix --> with one <!-- /matrix --> after it'
  if [ -s "$page" ]; then find_marks || return 1; fi
  reason='nothing can be written beside it'
  { (: >"$beside") && rm "$beside"; } 2>/dev/null
}

# put_table: into the file of --markdown, which is as it was until all of the new one is written. It is looked at once
# more: hours may have passed.
put_table() {
  takes_table || return 1
  reason='it cannot be written'
  if { write_page && mv -f "$beside" "$page"; } 2>/dev/null; then return 0; fi
  rm -f "$beside"
  return 1
}

# write_page: beside, with the mode of the old one.
write_page() {
  if [ ! -s "$page" ]; then
    [ ! -e "$page" ] || cp -p "$page" "$beside" || return 1
    cat "$matrix/table.md" >"$beside"
    return
  fi
  cp -p "$page" "$beside" && head -n "$opening" "$page" >"$beside" && cat "$matrix/table.md" >>"$beside" &&
    tail -n "+$closing" "$page" >>"$beside"
}
