#!/bin/sh
# What extras/setup says where it cannot install, with stand-ins for apt and sudo, and make in a folder with a blank. Says
# "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MAKELEVEL

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok setup: $2"; else echo "FAILED setup: $2"; fi
}

# ---- packages.sh

# fake NAME, with a script on standard input: the only commands that packages.sh finds are these and the links below. HAS and KNOWS
# name what dpkg has, and what apt knows once it has read its lists, if there is a NETWORK.
fake() { { echo '#!/bin/sh'; cat; } >"$work/fakes/$1" && chmod +x "$work/fakes/$1"; }
mkdir "$work/fakes" "$work/tools"
for tool in sh cat cut env grep sed tail touch tr; do ln -s "$(command -v "$tool")" "$work/tools"; done
fake id <<'END'
echo "${UNDER:-1000}"
END
fake dpkg-query <<'END'
for package; do :; done
grep -qxF "$package" "$STATE/has" && echo installed
END
fake apt-cache <<'END'
[ -e "$STATE/lists" ] && grep -qxF "$2" "$STATE/knows" && echo "$2 | 1.0 | http://mirror.example/debian stable/main amd64 Packages"
END
# apt-get(8): 100 on error; an update that reaches no server only warns.
fake apt-get <<'END'
echo "apt-get $*" >>"$STATE/calls"
case "$*" in
  "-q update")
    [ -e "$STATE/network" ] || { echo "W: Some index files failed to download." >&2; exit 0; }
    touch "$STATE/lists"
    [ ! -e "$STATE/gone" ] || { echo "E: The repository 'http://gone.example stable Release' does not have a Release file." >&2; exit 100; } ;;
  "-q install -y --no-install-recommends "*)
    shift 4
    for package; do
      [ -e "$STATE/lists" ] && grep -qxF "$package" "$STATE/knows" || { echo "E: Unable to locate package $package" >&2; exit 100; }
    done
    printf '%s\n' "$@" >>"$STATE/has" ;;
  *) exit 100 ;;
esac
END
# sudo(8): 1 if it may not run the command.
fake sudo <<'END'
[ ! -e "$STATE/refuses" ] || { echo "sudo: a terminal is required to read the password" >&2; exit 1; }
exec "$@"
END

# machine WITHOUT STATE... : a fresh one, without these commands, and with these files in its state
machine() {
  rm -rf "$work/state" "$work/path"
  mkdir "$work/state"
  cp -R "$work/fakes" "$work/path"
  for command in $1; do rm "$work/path/$command"; done
  shift
  for file in "$@"; do touch "$work/state/$file"; done
  echo make >"$work/state/has"
  printf '%s\n' make g++ libcli11-dev pkgconf >"$work/state/knows"
}

# needs STATUS LAST PACKAGES...: packages.sh ends with this status, and its last line is LAST
needs() {
  expected=$1 last=$2
  shift 2
  timeout 60 env STATE="$work/state" PATH="$work/path:$work/tools" sh extras/setup/packages.sh "$@" >"$work/out" 2>"$work/err" </dev/null
  [ $? -eq "$expected" ] && [ ! -s "$work/out" ] && [ "$(tail -n 1 "$work/err")" = "$last" ] || { cat "$work/out" "$work/err"; false; }
}
says() { [ "$(wc -l <"$work/err")" -eq "$1" ] || { cat "$work/err"; false; }; }
remedy="Packages are missing, and could not be installed (is there a network, and is this Debian 12, Ubuntu 24.04 or later?). Run \
as root: apt-get update && apt-get install --no-install-recommends"

machine "" network
needs 0 "Installing what is missing: g++ libcli11-dev pkgconf" make g++ libcli11-dev 'pkg-config|pkgconf' && says 1
verdict $? "what is missing is installed, by the name that apt knows"
needs 0 "" make g++ libcli11-dev 'pkg-config|pkgconf' && [ "$(wc -l <"$work/state/calls")" -eq 2 ]
verdict $? "nothing is said or called once it is there"
needs 0 "apt has no chromium: what needs it is left out" g++ 'chromium?' && says 1 && [ "$(wc -l <"$work/state/calls")" -eq 2 ]
verdict $? "a package that apt lacks and that may be left out is left out, without reading the lists again"
machine "" network gone
needs 0 "Installing what is missing: g++" g++
verdict $? "a repository that has gone is no reason not to install from the others"
machine "" network lists refuses
echo chromium >>"$work/state/knows"
needs 1 "$remedy g++ libcli11-dev" g++ libcli11-dev
verdict $? "a sudo that may not install names the packages"
needs 0 "$remedy chromium" make 'chromium?'
verdict $? "... and is no failure if only what may be left out is missing"
machine sudo network
needs 1 "$remedy g++" g++ && [ ! -e "$work/state/calls" ]
verdict $? "without sudo it names the packages"
UNDER=0 needs 0 "Installing what is missing: g++" g++
verdict $? "root needs no sudo"
machine ""
needs 1 "$remedy g++" g++
verdict $? "without a network it names the packages"
machine dpkg-query
needs 0 "This is not Debian or Ubuntu: if something is missing, install it by hand. The Debian packages: g++ chromium pkg-config" \
  g++ 'chromium?' 'pkg-config|pkgconf' && says 1
verdict $? "elsewhere it names the packages, and the work goes on"

# ---- make

tree=$work/tree
mkdir "$tree"
tar cf - --exclude=./build --exclude=./.git . | tar xof - -C "$tree"
make -s -j8 -C "$tree" demo SKETCH=None >"$work/out" 2>&1
grep -q 'There is no sketch None/None.ino' "$work/out" && ! grep -i warning "$work/out"
verdict $? "make -j8 warns of nothing"
[ -z "$(make -s -C "$tree" help | grep -E '.{81}')" ]
verdict $? "make help fits 80 columns"

folder="$work/a folder"
mkdir "$folder"
cp Makefile "$folder"
! make -s -C "$folder" demo >"$work/out" 2>&1 && grep -q '^make: the name of this folder has a blank' "$work/out"
verdict $? "in a folder with a blank make says that it has to have another name"
