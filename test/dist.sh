#!/bin/sh
# What `make dist` builds: each file is run, opened or unpacked. Says "ok ...", "FAILED ..." or "skipped ...".
# BUILD: an absolute folder for what is built. DIST: what `make dist` has built.
set -u
cd "$(dirname "$0")/.." || exit 1
export BUILD="${BUILD:-$PWD/build/test}" DIST="${DIST:-$PWD/dist}"
work=$BUILD/dist-check
version=$(sed -n 's/^version=//p' library.properties)

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok dist: $2"; else echo "FAILED dist: $2"; fi
}
skipped() { echo "skipped dist: $1"; }

printf '\ndist: what a release offers\n'
rm -rf "$work"
mkdir -p "$work"
(cd "$DIST" && sha256sum --check --strict --quiet SHA256SUMS) &&
  [ "$(wc -l <"$DIST/SHA256SUMS")" -eq "$(find "$DIST" -type f ! -name SHA256SUMS | wc -l)" ]
verdict $? "SHA256SUMS has every file"
[ "$(unzip -p "$DIST/DecodeSBus-$version.zip" DecodeSBus/library.properties | sed -n 's/^version=//p')" = "$version" ]
verdict $? "the ZIP is version $version"

# ---- sbus

recording=$PWD/test/recordings/paper.txt
for pack in gzip xz; do $pack -c "$recording" >"$work/paper.$pack"; done
python3 -c 'import sys, zipfile; zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED).write(sys.argv[2])' \
  "$work/paper.zip" "$recording"

# Prints what this sbus makes of them, with its exit status: 1 where `doctor` has found a fault.
says() {  # SBUS
  for arguments in --version 'doctor sim:uninverted --simulated-time' "csv $recording" "csv $work/paper.gzip" \
    "csv $work/paper.xz" "csv $work/paper.zip"; do
    # shellcheck disable=SC2086  # arguments, to be split
    timeout 60 "$1" $arguments 2>&1
    echo "status $?"
  done
}

mkdir "$work/deb"
package=$DIST/sbus_${version}_$(dpkg --print-architecture).deb
dpkg-deb -x "$package" "$work/deb" && says "$work/deb/usr/bin/sbus" >"$work/says"
grep -q '^Wrong polarity' "$work/says" && [ "$(grep -c '^status 0$' "$work/says")" -eq 5 ] &&
  [ "$(grep -c '^995,993,1811,' "$work/says")" -ge 4 ]
verdict $? "the package's sbus finds a wrong polarity, and reads recordings packed by gzip, xz and ZIP"
depends=$(dpkg-deb -f "$package" Depends)
for library in libarchive libncursesw libserialport; do
  case $depends in *"$library"[0-9]*) ;; *) verdict 1 "the package depends on $library: $depends" ;; esac
done
listed="usr/share/bash-completion/completions/sbus usr/share/doc/sbus/copyright
  usr/share/fish/vendor_completions.d/sbus.fish usr/share/man/man1/sbus.1.gz usr/share/zsh/site-functions/_sbus"
lacks=$(for file in $listed; do [ -s "$work/deb/$file" ] || echo "$file"; done)
[ -z "$lacks" ] || echo "$lacks"
[ -z "$lacks" ] && (cd "$work/deb" && dpkg-deb --ctrl-tarfile "$package" | tar xO ./md5sums | md5sum --check --quiet)
verdict $? "the package has manual, completion for three shells, and licence"
# has FILE WORDS...: each in a line of its own
has() {
  file=$1
  shift
  for words; do grep -qF "$words" "$file" || { echo "$file lacks: $words"; return 1; }; done
}
has "$work/deb/usr/share/doc/sbus/copyright" 'DecodeSBus maintainers' 'Henry Schreiner' 'Niels Lohmann'
verdict $? "... with those of CLI11 and JSON for Modern C++"
if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error,warning "$package"
  verdict $? "lintian accepts the package"
else
  skipped "lintian is not installed"
fi

archive=sbus-$version-linux-$(uname -m)
sbus=$work/static/bin/sbus
tar xzf "$DIST/$archive.tar.gz" --one-top-level="$work/static" && [ -x "$sbus" ] && ! LC_ALL=C readelf -d "$sbus" | grep -q NEEDED &&
  [ -s "$work/static/share/doc/sbus/copyright" ] && [ -s "$work/static/share/man/man1/sbus.1" ] &&
  says "$sbus" >"$work/static.says" && diff "$work/says" "$work/static.says"
verdict $? "$archive: it needs no library, and says what the package's sbus says"
has "$work/static/share/doc/sbus/copyright" 'DecodeSBus maintainers' 'Henry Schreiner' 'Niels Lohmann' 'Free Software Foundation' \
  'to link it with another one: '
verdict $? "$archive: it has the licences of what is in it, glibc's among them"

# ---- the page

has "$DIST/scope.html" 'Leon Sorokin' 'Niels Lohmann' 'The above copyright notice'
verdict $? "the page has the licences of what is in it"
if command -v chromium >/dev/null; then
  npm=$BUILD/scope/npm
  [ -d "$npm/node_modules" ] || npm=$PWD/build/scope/npm
  (cd "$npm" && timeout 120 node --input-type=module -e 'import { chromium } from "playwright-core";
    const browser = await chromium.launch({ executablePath: process.argv[1], args: ["--no-sandbox", "--disable-gpu"] });
    const page = await browser.newPage();
    await page.goto(process.argv[2]);
    await page.waitForFunction(() => /^(Fine|Lossy)$/.test(document.querySelector("#state").textContent));
    await browser.close();' "$(command -v chromium)" "file://$DIST/scope.html")
  verdict $? "the page opens from disk in Chromium, and shows frames"
else
  skipped "the page: there is no chromium here"
fi
