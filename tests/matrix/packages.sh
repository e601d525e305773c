# What targets need of the system, and bringing it. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

# is_there PACKAGE: what it brings is there.
is_there() {
  brings=$(row_of packages "$1" | cut -f 2)
  case $brings in
    /*) [ -e "$brings" ] ;;
    *) have "$brings" ;;
  esac
}

# packages_of_target: of the loaded one, its compiler's among them.
packages_of_target() {
  case $compiler in
    reference | cross) ;;
    clang++*) printf 'clang%s\n' "${compiler#clang++}" ;;
    *) echo "$compiler" ;;
  esac
  [ "$tools" != llvm- ] || echo llvm
  case $flags in *-stdlib=libc++*) printf '%s\n' libc++-14-dev libc++abi-14-dev ;; esac
  # shellcheck disable=SC2086
  [ -z "$needs" ] || printf '%s\n' $needs
}

# missing_of NAMES...: the packages that these targets and controls need and that are not there, on one line.
missing_of() {
  for name in "$@"; do
    load_target "$name" || load_control "$name"
    packages_of_target
  done | sort -u | while read -r package; do is_there "$package" || printf '%s ' "$package"; done
}

# bring_packages NAMES...: what may be installed is; which is still missing, the rows of the targets say.
bring_packages() {
  packages=$(missing_of "$@")
  [ -n "$packages" ] || return 0
  say "apt-get update && apt-get install -y --no-install-recommends ${packages% }"
  if [ "${ISOSTEP_NO_INSTALL:-}" = 1 ]; then
    say "isostep: ISOSTEP_NO_INSTALL=1 forbids to install them"
    return 0
  fi
  if ! have apt-get || [ "$(id -u)" != 0 ]; then
    say "isostep: packages are missing: run the line above as root"
    return 0
  fi
  export DEBIAN_FRONTEND=noninteractive
  # shellcheck disable=SC2086
  apt_get update && apt_get install -y --no-install-recommends $packages && return 0
  for package in $packages; do # one that this system does not have must not keep the others away
    apt_get install -y --no-install-recommends "$package" || say "isostep: $package cannot be installed"
  done
}
