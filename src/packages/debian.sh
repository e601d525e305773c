#!/bin/sh
# Debian packages of the sources that tarball.sh unpacked; lintian has nothing to say; installed into a system that has
# nothing else, their READMEs' own commands print the goldens.
# SPDX-License-Identifier: MIT
. "$ISOSTEP_ROOT/src/packages/common.sh"
tree=$work/sources/isostep-$version
[ -d "$tree/build/release" ] || red "tarball comes first: ./isostep package --only tarball --only debian"
for program in dpkg-buildpackage dh dh_python3; do have "$program" || not_here "no $program"; done
cd "$tree" || exit 70
# debhelper gives the build a home of its own, where ccache would find nothing.
if have ccache; then
  CCACHE_DIR=$(ccache --get-config cache_dir)
  export CCACHE_DIR
fi
export CCACHE_BASEDIR="$PWD" DEB_BUILD_OPTIONS="parallel=$(getconf _NPROCESSORS_ONLN) nocheck"

# debian/ from its templates.
rm -rf debian && mkdir -p debian/source || exit 70
templates=src/packages/debian
fill() { sed -e "s/@ABI@/$abi/g" -e "s/@VERSION@/$version/g" "$templates/$1" >"debian/$2" || exit 70; }
fill control.in control
fill rules rules && chmod +x debian/rules
fill libisostep.symbols.in "libisostep$abi.symbols"
fill libisostep.install "libisostep$abi.install"
for file in libisostep-dev.install libisostep-dev.docs libisostep-dev.examples python3-isostep.install \
  python3-isostep.docs python3-isostep.examples; do
  fill "$file" "$file"
done
echo '3.0 (native)' >debian/source/format
{
  sed '/@LICENSE@/d' "$templates/copyright.in" | sed "s/@COPYRIGHT@/$(sed -n 's/^Copyright (c) //p' LICENSE)/"
  sed -n '/^Permission/,$p' LICENSE | sed -e 's/^$/./' -e 's/^/ /'
} >debian/copyright
cat >debian/changelog <<LOG
isostep ($version) unstable; urgency=medium

  * Release $version: see CHANGELOG.md.

 -- isostep authors <isostep@packages.invalid>  $(date -R -d "@$(stat -c %Y CHANGELOG.md)")
LOG

# What tarball.sh compiled is not thrown away.
dpkg-buildpackage --build=binary --no-sign --no-check-builddeps --no-pre-clean || red "dpkg-buildpackage fails"
cd .. || exit 70
names="libisostep${abi}_${version}_$(dpkg --print-architecture) libisostep-dev_${version}_$(dpkg --print-architecture)"
names="$names python3-isostep_${version}_all"
debs=''
for name in $names; do
  [ -f "$name.deb" ] || red "$name.deb was not made"
  debs="$debs $name.deb"
  cp "$name.deb" "$out/"
done
if have lintian; then
  # shellcheck disable=SC2086
  said=$(lintian --fail-on none --allow-root $debs 2>&1 | grep -v '^N: ')
  [ -z "$said" ] || { echo "$said"; red "lintian speaks: $(echo "$said" | head -n 1)"; }
fi

# A clean system, made once.
[ "$(id -u)" = 0 ] || not_here "$(ls $debs | wc -l) packages built; only root can install them into a system of their own"
have mmdebstrap || have debootstrap || not_here "packages built; neither mmdebstrap nor debootstrap is here to try them"
base=$work/clean-system
. /etc/os-release
needed=gcc,g++,libc6-dev,pkgconf,cmake,make,python3,python3-numpy
if [ ! -f "$base.tar" ]; then
  if have mmdebstrap; then
    mmdebstrap --format=tar --variant=minbase --dpkgopt=force-unsafe-io --include="$needed" "$VERSION_CODENAME" \
      "$base.tar.new"
  else
    rm -rf "$base.new" && debootstrap --variant=minbase --include="$needed" "$VERSION_CODENAME" "$base.new" \
      http://deb.debian.org/debian && tar -cf "$base.tar.new" -C "$base.new" . && rm -rf "$base.new"
  fi || not_here "packages built; no Debian mirror is reached to make a system that tries them"
  mv "$base.tar.new" "$base.tar" || exit 70
fi
system=$work/system
rm -rf "$system" && mkdir "$system" && tar -xf "$base.tar" -C "$system" || exit 70
# shellcheck disable=SC2086
cp $debs "$system/tmp/" && chroot "$system" sh -c 'dpkg --force-unsafe-io -i /tmp/*.deb' || red "the packages do not install"

# try_page PAGE: its commands, in the clean system, one after another; each prints the goldens.
try_page() {
  [ -f "$system/$1" ] || red "$1 is not in the package"
  commands_of "$system/$1" >"$system/tmp/commands.sh"
  [ -s "$system/tmp/commands.sh" ] || red "$1 has no commands"
  mkdir -p "$system/home/user" && prints_goldens chroot "$system" sh -ec 'cd /home/user && . /tmp/commands.sh'
}
try_page usr/share/doc/libisostep-dev/README.Debian.md
try_page "usr/share/doc/libisostep-dev/README.C++.md"
try_page usr/share/doc/python3-isostep/README.Debian.md
# Removed, nothing of them stays.
chroot "$system" dpkg --purge python3-isostep libisostep-dev "libisostep$abi" || red "the packages cannot be removed"
left=$(find "$system/usr" -name '*isostep*' -not -path '*/doc/*' | head -n 1)
[ -z "$left" ] || red "$left stays when the packages are removed"
green "$(echo $debs | wc -w) packages, lintian silent, README commands run in a clean $VERSION_CODENAME"
