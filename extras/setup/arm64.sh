#!/bin/sh
# Unpacks arm64 packages of Debian into a folder, for a cross compiler: apt works with lists of its own there, so that it needs
# neither root nor a second architecture in the system.
#   arm64.sh FOLDER PACKAGE...
set -eu
mkdir -p "$1/lists/partial" "$1/cache/archives/partial"
cd "$1"
shift
: >status
apt() {
  apt-get -qq -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Sandbox::User="$(id -un)" -o Dir::State="$PWD" \
    -o Dir::State::status="$PWD/status" -o Dir::Cache="$PWD/cache" "$@"
}
apt update || :  # fails where one of several repositories has gone, or has no arm64
apt download "$@"
for package in *.deb; do dpkg-deb -x "$package" .; done
# An Arduino library has no links, not even in build/.
rm -rf usr/share/doc
find . -type l | while read -r link; do
  target=$(readlink -f "$link") || target=
  rm "$link"
  case $target in "$PWD"/*) [ ! -f "$target" ] || cp "$target" "$link" ;; esac
done
