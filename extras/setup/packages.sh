#!/bin/sh
# Installs those of the named Debian packages that this machine lacks, or says exactly what to install.
#
#   sh extras/setup/packages.sh g++ doctest-dev ...
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
  echo "This is not Debian or Ubuntu: if something is missing, install it by hand. The Debian packages: $(echo "$*" | sed 's/|[^ ]*//g; s/?//g')" >&2
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

# Runs apt-get, which says what went wrong, as sudo and the shell do.
apt() {
  [ "$(id -u)" = 0 ] || sudo=sudo
  ${sudo:-} env DEBIAN_FRONTEND=noninteractive apt-get -q "$@" >&2
}

# At most twice: only an installed clang can say which run-time library it needs.
# shellcheck disable=SC2034,SC2046,SC2086  # lists of packages, to be split
for round in first second; do
  list=$(missing "$@")
  [ -n "$list" ] || exit 0
  # apt has no lists on a fresh machine, and old ones elsewhere. For packages that it is known to lack they are not read in
  # every run.
  if [ -z "${updated:-}" ] && { [ -z "$(apt-cache madison make 2>/dev/null)" ] || [ -n "$(to_install $list 2>/dev/null)" ]; }; then
    apt update  # fails where one of several repositories has gone: the others may have the packages
    updated=yes
  fi
  chosen=$(to_install $list)
  [ -n "$chosen" ] || exit 0
  echo "Installing what is missing:" $chosen >&2
  apt install -y --no-install-recommends $chosen && continue
  echo "Packages are missing, and could not be installed (is there a network, and is this Debian 12, Ubuntu 24.04 or later?)." \
    "Run as root: apt-get update && apt-get install --no-install-recommends" $(to_install $list 2>/dev/null) >&2
  for package in $list; do
    case $package in *\?) ;; *) exit 1 ;; esac  # without an 'a?' the work goes on
  done
  exit 0
done
