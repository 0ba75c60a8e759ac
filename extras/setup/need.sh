#!/bin/sh
# Installs those of the named Debian packages that this machine lacks, or says exactly what to install.
#
#   sh extras/setup/need.sh g++ doctest-dev ...
#
# Silent and quick where nothing is missing. `clang-sanitizers` stands for the run-time library of the clang at hand,
# whose package carries clang's version in its name.
set -u

installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

clang_sanitizers() {
  version=$(clang++ -dumpversion 2>/dev/null | cut -d. -f1)
  [ -n "$version" ] || return 0  # no clang yet: it is on the list, and this is asked again once it is there
  echo 'int main() {}' | clang++ -x c++ -fsanitize=address,undefined,fuzzer-no-link -o /dev/null - 2>/dev/null ||
    echo "libclang-rt-$version-dev"
}

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "This is not Debian or Ubuntu, so nothing is installed. Needed are, by their Debian names: $*" >&2
  exit 0
fi

missing() {
  for package in "$@"; do
    case $package in
      clang-sanitizers) clang_sanitizers ;;
      *) installed "$package" || echo "$package" ;;
    esac
  done
}

install() {
  if [ "$(id -u)" = 0 ]; then
    as_root=
  elif command -v sudo >/dev/null 2>&1; then
    as_root=sudo
  else
    echo "Missing packages, and no sudo to install them with. As root: apt-get install $*" >&2
    exit 1
  fi
  echo "Installing what is missing: $*" >&2
  $as_root apt-get update -q >&2 &&
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$@" >&2 || {
    echo "That did not work. By hand: apt-get install $*" >&2
    exit 1
  }
}

# Twice at the most: only an installed clang can say which run-time library it wants.
for round in first second; do
  list=$(missing "$@")
  [ -z "$list" ] && exit 0
  # shellcheck disable=SC2086  # a list of packages, to be split
  install $list
done
