#!/bin/sh
# Installs those of the named Debian packages that this machine lacks, or says exactly what to install.
#
#   sh extras/setup/need.sh g++ doctest-dev ...
#
# 'a|b' is a, or b where apt has no a. 'a?' is left out where apt does not have it, and a line says so: then the tests that
# need it are skipped. Silent and quick where nothing is missing. `clang-sanitizers` stands for the run-time library of the
# installed clang, whose package has clang's version in its name.
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
  echo "This is not Debian or Ubuntu, so nothing is installed. Install these packages, by their Debian names: $*" >&2
  exit 0
fi

names() { echo "${1%\?}" | tr '|' ' '; }

any_installed() {  # PACKAGE...
  for name in "$@"; do
    installed "$name" && return
  done
  return 1
}

# shellcheck disable=SC2046  # names, to be split
missing() {
  for package in "$@"; do
    case $package in
      clang-sanitizers) clang_sanitizers ;;
      *) any_installed $(names "$package") || echo "$package" ;;
    esac
  done
}

# The first of the names that apt can install, or nothing.
first_known() {
  for name in $(names "$1"); do
    if [ -n "$(apt-cache madison "$name" 2>/dev/null)" ]; then
      echo "$name"
      return
    fi
  done
}

# What is to be installed for the packages given. A fresh machine has no lists yet: then apt knows nothing.
to_install() {
  for package in "$@"; do
    name=$(first_known "$package")
    case $name$package in
      *\?) if [ -n "$name" ]; then echo "$name"; else
        echo "apt has no $(names "$package"): what needs it is left out" >&2
      fi ;;
      *) echo "${name:-$(names "$package" | cut -d' ' -f1)}" ;;
    esac
  done
}

# shellcheck disable=SC2086  # a list of packages, to be split
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null 2>&1; then
    sudo "$@"
  else
    echo "Missing packages, and no sudo to install them with. As root: apt-get install $(to_install $list 2>/dev/null | tr '\n' ' ')" >&2
    exit 1
  fi
}

update() {
  as_root apt-get update -q >&2 || {
    echo "apt-get update failed. Run it by hand." >&2
    exit 1
  }
}

install() {
  echo "Installing what is missing: $*" >&2
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$@" >&2 || {
    echo "That did not work. Install them by hand: apt-get install $*" >&2
    exit 1
  }
}

[ -z "$(missing "$@")" ] && exit 0
list=$(missing "$@")
# Not for packages that apt is known to lack: that would take time in every run.
# shellcheck disable=SC2086  # lists of packages, to be split
if [ -z "$(apt-cache madison make 2>/dev/null)" ] || [ -n "$(to_install $list 2>/dev/null)" ]; then
  update
fi
# At most twice: only an installed clang can say which run-time library it needs.
for round in first second; do
  list=$(missing "$@")
  # shellcheck disable=SC2086
  chosen=$(to_install $list)
  [ -z "$chosen" ] && exit 0
  # shellcheck disable=SC2086
  install $chosen
done
