#!/bin/sh
# Copies the repository to a folder whose name has no blank, and prints that name. The copy's build/ is a link to build/ here.
# The folder is that of the last time, since what was compiled names its sources there. In /tmp any user can take a name:
# only a folder that mktemp has made, and that is still ours, is used.
set -eu
cd "$(dirname "$0")/../.."
mkdir -p build
copy=$(cat build/copy 2>/dev/null || :)
case $copy in /tmp/DecodeSBus.??????) ;; *) copy=none ;; esac
if [ -z "$(find "$copy" -maxdepth 0 -type d -user "$(id -u)" 2>/dev/null)" ]; then
  copy=$(mktemp -d /tmp/DecodeSBus.XXXXXX)
  find build -name '*.d' | while read -r dependencies; do
    rm -f "$dependencies" "${dependencies%.d}" "${dependencies%.d}.o"
  done
  rm -f build/copy
  echo "$copy" >build/copy
fi
find "$copy" -mindepth 1 -maxdepth 1 -exec rm -rf {} +
tar cf - --exclude=./build --exclude=./.git . | tar xof - -C "$copy"
chmod 700 "$copy"  # tar has given it the mode of this one
ln -s "$PWD/build" "$copy/build"
echo "$copy"
