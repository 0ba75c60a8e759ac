#!/bin/sh
# Builds what a release offers: the Arduino ZIP, the page, a Debian package of sbus, sbus with its libraries in it, and
# SHA256SUMS.
# BUILD: where it is compiled (build); DIST: where the files go (dist).
set -eu
umask 022
cd "$(dirname "$0")/../.."
root=$PWD
build=${BUILD:-$root/build}
# The name that `make sbus` and `make scope` have for it: the files with what objects depend on have this name.
for_make=${BUILD:-../../build}
dist=${DIST:-$root/dist}
work=$build/dist
version=$(sed -n 's/^version=//p' library.properties)
maintainer=$(sed -n 's/^maintainer=//p' library.properties)
architecture=$(dpkg --print-architecture)
homepage=$(sed -n 's/^url=//p' library.properties)
headers='libcli11-dev nlohmann-json3-dev'
libraries='libserialport-dev libarchive-dev libncurses-dev nettle-dev liblzma-dev libzstd-dev libbz2-dev zlib1g-dev'
zip=$(sh extras/setup/zip.sh)
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH

run_make() { "${MAKE:-make}" --no-print-directory -s "$@"; }

# Installs this sbus to a folder, as `make install` does, and its licence, with those of the packages that are in it.
install_to() {  # SBUS FOLDER PREFIX PACKAGE...
  run_make install SBUS="$1" DESTDIR="$2" PREFIX="$3" >/dev/null
  mkdir -p "$2$3/share/doc/sbus"
  copyright=$2$3/share/doc/sbus/copyright
  shift 3
  {
    cat LICENSE
    for package; do
      printf '\n---- %s\n\n' "$package"
      cat "/usr/share/doc/$package/copyright"
    done
  } >"$copyright"
}

package_static() {  # SBUS NAME
  folder=$work/$2
  # shellcheck disable=SC2086  # names, to be split
  install_to "$1" "$folder" '' $headers $libraries libc6-dev
  strip "$folder/bin/sbus"
  # The LGPL asks for a way to link with another glibc.
  printf '\n---- sbus is linked with glibc. Its source, to link it with another one: %s\n' "$homepage" >>"$copyright"
  tar cf - -C "$folder" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" bin share |
    gzip -9n >"$dist/$2.tar.gz"
}

package_debian() {  # SBUS
  folder=$work/debian-package
  # shellcheck disable=SC2086  # names, to be split
  install_to "$1" "$folder" /usr $headers
  strip --remove-section=.comment --remove-section=.note "$folder/usr/bin/sbus"
  cat >"$work/changelog" <<END
sbus ($version) unstable; urgency=medium

  * $homepage: CHANGELOG.md has the changes.

 -- $maintainer  $(date -R -u -d "@$SOURCE_DATE_EPOCH")
END
  gzip -9n <"$work/changelog" >"$folder/usr/share/doc/sbus/changelog.gz"
  gzip -9n "$folder/usr/share/man/man1/sbus.1"
  find "$folder" -type d -exec chmod 755 {} +
  mkdir -p "$folder/DEBIAN" "$work/debian"
  (cd "$folder" && find usr -type f -print0 | LC_ALL=C sort -z | xargs -0 md5sum >DEBIAN/md5sums)
  printf 'Source: sbus\n\nPackage: sbus\nArchitecture: any\n' >"$work/debian/control"
  depends=$(cd "$work" && dpkg-shlibdeps -O "$folder/usr/bin/sbus" | sed -n 's/^shlibs:Depends=//p')
  cat >"$folder/DEBIAN/control" <<END
Package: sbus
Version: $version
Architecture: $architecture
Maintainer: $maintainer
Installed-Size: $(du -sk --apparent-size "$folder/usr" | cut -f1)
Depends: $depends
Section: electronics
Priority: optional
Homepage: $homepage
Description: looks at, records and diagnoses S.Bus lines of radio control
 S.Bus is the serial line by which a radio-control receiver sends its
 channels. sbus reads that line from a serial adapter, a recording or a
 logic analyser's capture: as curves, tables or a page on the terminal. It
 says what is wrong with a line, sends frames, and makes the transmitter a
 game controller.
END
  dpkg-deb --root-owner-group -Zxz --build "$folder" "$dist/sbus_${version}_$architecture.deb" >/dev/null
}

rm -rf "$work" "$dist"
mkdir -p "$work" "$dist"
cp "$zip" "$dist"
run_make -C extras/scope BUILD="$for_make/scope"
cp "$build/scope/index.html" "$dist/scope.html"
run_make -C extras/cli BUILD="$for_make/sbus" "$for_make/sbus/sbus" "$for_make/sbus/sbus-static"
package_debian "$build/sbus/sbus"
package_static "$build/sbus/sbus-static" "sbus-$version-linux-$(uname -m)"
(cd "$dist" && sha256sum ./* | sed 's, \./, ,' >"$work/SHA256SUMS" && mv "$work/SHA256SUMS" .)
echo "${dist#"$root"/}"
ls -l "$dist" >&2
