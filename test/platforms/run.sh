#!/bin/sh
# The core on other platforms: CMake projects take it, and so do stand-ins of ESP-IDF and Zephyr; each runs the code of
# other-platforms.md on known frames (Receiver.cpp), and Python its class for MicroPython. The manifests are compared with their readers' rules. Says "ok ..." or
# "FAILED ...".
# BUILD: an absolute folder for what is built.
set -u
unset MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 1
root=$PWD
here=$root/test/platforms
out=${BUILD:-$root/build/test}/platforms
page=$out/page.cpp

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok platforms: $2"; else echo "FAILED platforms: $2"; fi
}

printf '\nplatforms: CMake, ESP-IDF, Zephyr, PlatformIO\n'
rm -rf "$out"
mkdir -p "$out"
awk '/^```$/ { inside = 0 } inside; /^```cpp$/ { inside = 1 }' extras/docs/other-platforms.md >"$page"
/usr/bin/python3 "$here/manifests.py" "$out" || { verdict 1 "the manifests can be read"; exit; }

awk '/^```$/ { inside = 0 } inside; /^```python$/ { inside = 1 }' extras/docs/other-platforms.md >"$out/sbus.py"
python3 "$here/python.py" "$out" test/recordings/frsky-neutral.txt
verdict $? "the class for MicroPython reads a recording, and with lost bytes no wrong frame"

# configure PROJECT NAME [OPTIONS]: into the folder NAME
configure() {
  project=$1
  name=$2
  shift 2
  cmake -S "$here/$project" -B "$out/$name" -DPAGE="$page" "$@"
}

# run WHAT PROJECT NAME [OPTIONS]: configures and builds that, and runs the receiver
run() {
  what=$1
  shift
  configure "$@" && cmake --build "$out/$2" -j 2 && "$out/$2/receiver" && members "$out/$2"
  verdict $? "$what"
}

# members FOLDER: the library built there is made of src/sbus and src/sbus2, and nothing else. (An installed one was built elsewhere.)
members() {
  archive=$(find "$1" -name '*.a')
  [ -z "$archive" ] || [ "$(ar t "$archive" | sed 's/\.o$//;s/\.obj$//' | sort)" = "$(cd "$root/src" && ls sbus*/*.cpp | sed 's,.*/,,' | sort)" ]
}

run "a project that fetches the library runs" consumer fetched -DSOURCE="$root"

# A version other than ours: CMakeLists.txt must not contain a version.
mkdir "$out/copy"
cp -r CMakeLists.txt Makefile src "$out/copy"
sed 's/^version=.*/version=2.1.3/' library.properties >"$out/copy/library.properties"
cmake -S "$out/copy" -B "$out/copy" >"$out/said" 2>&1
[ $? -eq 1 ] && grep -q 'overwrite the Makefile' "$out/said" && cmp Makefile "$out/copy/Makefile"
verdict $? "CMake does not build in the folder of the Makefile"
rm "$out/copy/CMakeCache.txt"

cmake -S "$out/copy" -B "$out/library" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Werror" && cmake --build "$out/library" -j 2 &&
  cmake --install "$out/library" --prefix "$out/installed" && members "$out/library" &&
  mv "$out/installed" "$out/moved" && rm -r "$out/library" "$out/copy"
verdict $? "the library is installed"
[ "$(cd "$out/moved/include/decodesbus" && find . -type f | sort)" = "$(cd src && find ./sbus ./sbus2 -name '*.h' | sort)" ]
verdict $? "the installed library has the headers of the core, and no others"
[ "$(ls "$out/moved/include")" = decodesbus ]
verdict $? "... in a folder of its own"
run "a project that finds 2.1 of it installed, and moved, runs" consumer found -DCMAKE_PREFIX_PATH="$out/moved" -DVERSION=2.1
for other in 1.9 2.2 3.0; do
  configure consumer "not-$other" -DCMAKE_PREFIX_PATH="$out/moved" -DVERSION="$other" >"$out/said" 2>&1
  [ $? -eq 1 ] && grep -q 'decodesbusConfig.cmake, version: 2.1.3' "$out/said"
  verdict $? "a project that asks for $other is told that there is 2.1.3"
done

# by_pkg_config: compiles and links page and receiver with what pkg-config says, and runs them
by_pkg_config() {
  PKG_CONFIG_PATH=$(dirname "$(find "$out/moved" -name decodesbus.pc)")
  export PKG_CONFIG_PATH
  [ "$(pkg-config --modversion decodesbus)" = 2.1.3 ] || return
  mkdir "$out/pkg-config"
  # shellcheck disable=SC2046  # the flags are words
  g++ -std=c++11 $(pkg-config --cflags decodesbus) -c "$page" -o "$out/pkg-config/page.o" &&
    g++ -std=c++17 -I"$root/test" $(pkg-config --cflags decodesbus) "$here/Receiver.cpp" "$out/pkg-config/page.o" \
      $(pkg-config --libs decodesbus) -o "$out/pkg-config/receiver" && "$out/pkg-config/receiver"
}
if command -v pkg-config >/dev/null; then
  by_pkg_config
  verdict $? "a project that finds 2.1.3 of it by pkg-config, moved, runs"
else
  echo "skipped platforms: there is no pkg-config"
fi

# The files that the registry of components takes.
mkdir -p "$out/components/decodesbus"
xargs tar cf - <"$out/component" | tar xf - -C "$out/components/decodesbus"
run "a component of ESP-IDF runs" idf idf -DCOMPONENT="$out/components/decodesbus"

{ read -r folder && read -r option; } <"$out/module"
configure zephyr without -DMODULE="$root" -DCMAKE_DIR="$folder" >"$out/said" 2>&1 && grep -x -e '-- libraries: ' "$out/said"
verdict $? "a module of Zephyr is not there where CONFIG_$option is not set"
run "... and runs where it is" zephyr zephyr -DMODULE="$root" -DCMAKE_DIR="$folder" -D"CONFIG_$option=y"
