#!/bin/sh
# Runs every command that README.md, CONTRIBUTING.md, maintaining.md, ftdi.md ("Record a receiver") and `make help` name, and
# says "ok ..." or "FAILED ...". A command that no line below runs is a failure; so is one below that no page names.
# Placeholders have a number or a name here, and what takes long is made short.
# The commands run in a copy of the repository, on what other steps have built there: run.sh calls this last.
# BUILD: an absolute folder for what is built.
set -u
cd "$(dirname "$0")/.." || exit 1
export BUILD="${BUILD:-$PWD/build/test}" STEP_LOGS="${STEP_LOGS:-$BUILD/steps}"
unset MAKEFLAGS MAKELEVEL CAPTURES V STEPS SKETCH RECORDING PORT SCOPE_PORT PREFIX DESTDIR FRAMES SEED ONLY FULL WITHOUT
root=$PWD

# check REGEX SHELL COMMAND...   SHELL is what the pages' COMMANDs are here. It ends well, and a line of its output is like
# REGEX. (Without a COMMAND it is SHELL.)
check() {
  regex=$1 shell=$2
  shift 2
  [ $# -gt 0 ] || set -- "$shell"
  (eval "$shell") >output 2>&1 </dev/null
  status=$?
  for command in "$@"; do
    echo "$command" >>tested
    if grep -q '^skipped: ' output; then
      echo "skipped commands: $command: $(sed -n 's/^skipped: //p' output)"
    elif [ $status -eq 0 ] && tr -d '\r' <output | grep -qE -e "$regex"; then
      echo "ok commands: $command"
    else
      tail -n 20 output | sed 's/^/  /'
      echo "FAILED commands: $command: status $status, or no line of its output is like $regex"
    fi
  done
}

# wait_for COMMAND...: until it succeeds, for 5 minutes
wait_for() {
  tries=0
  until "$@"; do
    tries=$((tries + 1))
    [ $tries -lt 3000 ] || return 1
    sleep 0.1
  done
}

# until_says REGEX COMMAND...: runs a command that does not end until it says that, then presses Ctrl-C; $then is done before
then=:
until_says() {
  regex=$1
  shift
  timeout 300 "$@" >said 2>&1 &
  command=$!
  says_or_ended() { grep -qE "$regex" said || ! kill -0 $command 2>/dev/null; }
  wait_for says_or_ended && grep -qE "$regex" said && eval "$then"
  result=$?
  kill -INT $command
  wait $command
  cat said
  return $result
}

# adapter [ARGUMENTS]: a pseudo-terminal with a receiver, for 2 seconds from when it is opened; its name is in $adapter
adapter() {
  rm -f terminal
  rm -f sent.txt
  build/sbus/sbus record sim -o sent.txt --simulated-time --seconds 2 "$@" 2>/dev/null
  timeout 60 build/sbus/sbus send sent.txt >terminal 2>/dev/null &
  wait_for test -s terminal
  adapter=$(cat terminal)
}

# small: leaves one unit test, one example and one recording, so that what takes all of them is quick
small() {
  rm -rf test/host
  find test/unit/*Test.cpp ! -name FrameTest.cpp ! -name LinkTest.cpp -delete
  find test/recordings/*.txt ! -name paper.txt -delete
  find test/golden/*.csv ! -name 'DecodeSBus*' ! -name README.csv ! -name receivers.csv -delete
  find examples -mindepth 1 -maxdepth 1 ! -name DecodeSBus -exec rm -r {} +
  find extras/docs/*.md ! -name receivers.md ! -name receiver.md ! -name rules.md ! -name measured.md ! -name maintaining.md -delete
  sed -i '/^DecodeSBus /!d' test/golden/LINES
}

# log STEP COMMAND: the log of that step of run.sh, which has run it; if there is none, the output of COMMAND
log() { cat "$STEP_LOGS/$1.log" 2>/dev/null || $2; }

newlib() { [ -z "$(extras/setup/arm-specs.sh)" ] || { echo "skipped: there is no newlib for ARM here"; false; }; }

printf '\ncommands: those of the pages are run\n'
copy=$(mktemp -d)
# What was compiled in the copy names its sources there, and would not be found again.
forget() {
  grep -rlF --include='*.d' "$copy/" "$BUILD" | while read -r dependencies; do rm -f "$dependencies" "${dependencies%.d}"; done
  rm -rf "$copy"
}
trap forget EXIT
mkdir -p "$copy/build" "$copy/bin" "$BUILD/sanitized/sketches" "$BUILD/tool" "$BUILD/scope"
tar cf - --exclude=./build --exclude=./.git . | tar xof - -C "$copy"
# What golden.sh, tool/run.sh and scope/run.sh have built, with their flags.
ln -s "$BUILD/sanitized/sketches" "$copy/build/host"
ln -s "$BUILD/tool" "$copy/build/sbus"
ln -s "$BUILD/scope" "$copy/build/scope"
sanitized=$(make -s -C test -f build.mk VARIANT=sanitized OUT="$BUILD/sanitized" settings \
  --eval="settings: ; @echo \"CXX='\$(CXX)' CXXFLAGS='\$(FLAGS)'\"")
cat >"$copy/bin/make" <<END
#!/bin/sh
case " \$* " in
  *" demo "* | *extras/host*) set -- "\$@" BUILD='$BUILD/sanitized/sketches' $sanitized ;;
  *" sbus "* | *" install "*) set -- "\$@" BUILD='$BUILD/tool' CXXFLAGS='$(sed -n 's/^flags="\(.*\)".*/\1/p' test/tool/run.sh)' ;;
  *" scope "* | *extras/scope*) set -- "\$@" BUILD='$BUILD/scope' ;;
  *) set -- "\$@" BUILD='$BUILD' ;;
esac
exec '$(command -v make)' --no-print-directory "\$@"
END
chmod +x "$copy/bin/make"
export PATH="$copy/bin:$copy/build/sbus:$PATH"
cd "$copy" || exit 1
check '^make demo ' 'make -s help | tee help' 'make help'
awk '/^## / { inside = /Record a receiver/ } inside' extras/docs/ftdi.md >recording

check decodeSBusFrame 'make docs && cat build/docs/html/classDecodeSBusOf.html ||
  [ "$(doxygen --version)" = 1.9.4 ] || echo "skipped: the warnings of this Doxygen are others"' 'make docs'

check '^build/sbus/sbus$' 'make sbus'
check '^sbus [0-9]+\.[0-9]+\.[0-9]+ \(DecodeSBus\)$' 'make install PREFIX=/usr/local DESTDIR="$PWD/a place" && cd "a place/usr/local" &&
  [ -s share/man/man1/sbus.1 ] && [ -s share/bash-completion/completions/sbus ] && [ -s share/zsh/site-functions/_sbus ] &&
  [ -s share/fish/vendor_completions.d/sbus.fish ] && bin/sbus --version' \
  'make install PREFIX=/usr/local'
check "^removed '.*/a place/usr/local/bin/sbus'$" '[ -n "$(find "a place" -type f)" ] &&
  make uninstall PREFIX=/usr/local DESTDIR="$PWD/a place" && [ -z "$(find "a place" -type f)" ] &&
  [ "$(cd "a place/usr/local" && echo * share/*)" = "bin share share/man" ] && make install PREFIX="$PWD/a place/it'"'"'s own" &&
  make uninstall PREFIX="$PWD/a place/it'"'"'s own" && [ "$(ls "a place")" = usr ]' 'make uninstall PREFIX=/usr/local'
check '<title>.*S.Bus' '
  then='"'"'node -e "fetch(process.argv[1]).then((answer) => answer.text()).then(console.log)" "$(grep -o "http://.*/" said)"'"'"'
  until_says http:// make scope SCOPE_PORT=0' 'make scope' 'make scope SCOPE_PORT=8000'

check '^webp light dark$' 'command -v chromium >/dev/null || echo "skipped: there is no chromium here"
  mkdir pictures && make -C extras/scope picture FOLDER="$PWD/pictures" && for colours in light dark; do
    size=$(wc -c <"pictures/scope-$colours.webp") && [ "$size" -gt 20000 ] && [ "$size" -lt 60000 ] || exit; done && echo webp light dark' \
  'make -C extras/scope picture'

check 'simulated FrSky R-XSR, 15 s' "until_says '^([0-9]+,){5}[0-9]' make demo" 'make demo'
check '^([0-9]+,){5}[0-9]+$' 'then="wait_for test -s curves.csv"
  until_says R-XSR sh -c "exec make demo >curves.csv" && ! grep -vE "^([0-9]+,){5}[0-9]+.$" curves.csv && cat curves.csv' 'make demo > curves.csv'
check '^Serial1: receiver at /dev/pts/' "adapter; until_says '^([0-9]+,){5}[0-9]' make demo SOURCE=\$adapter" 'make demo SOURCE=/dev/ttyUSB0'
check 'simulated FrSky receiver with 24 channels' "until_says 'receiver with 24 channels' make demo SOURCE=sim:24" 'make demo SOURCE=sim:24'
check '^PASS: [1-9][0-9]* frames sent' 'until_says PASS make demo SKETCH=examples/Loopback' 'make demo SKETCH=examples/Loopback'
check '^first flies, 0 changes; first: ' 'until_says "^first flies" make demo SKETCH=examples/TwoReceivers' 'make demo SKETCH=examples/TwoReceivers'
check '^1\. Move all sticks' "until_says 'CH4 ok' make demo SKETCH=examples/Calibrate" 'make demo SKETCH=examples/NAME'
check '^995,993,1811,992,0,0$' 'make demo SOURCE=test/recordings/paper.txt' 'make demo SOURCE=file'

check '^formatted$' 'git -C "$root" rev-parse -q --verify HEAD >/dev/null || echo "skipped: this is no clone"
  git clone -q "$root" formatted && cd formatted &&
  { make format 2>said || { grep -q "clang-format 14 is needed" said && echo "skipped: there is no clang-format 14 here"; }; } &&
  git diff --quiet && echo formatted' 'make format'
check '^Makefile$' 'git -C "$root" rev-parse -q --verify HEAD >/dev/null || echo "skipped: this is no clone"
  git clone -q "$root" DecodeSBus && cd DecodeSBus && ls' "git clone $(sed -n 's/^url=//p' library.properties) DecodeSBus && cd DecodeSBus"
# There is no adapter here: the path is compared with the source of what `sbus ports` prints.
check '"/sys/bus/usb-serial/devices/" \+ .* \+ "/latency_timer";' 'cat extras/line/system/LowLatency.cpp' \
  'echo 1 | sudo tee /sys/bus/usb-serial/devices/ttyUSB0/latency_timer'
check '\(0 with errors\), [1-9][0-9]* frames$' 'adapter; timeout 60 build/sbus/sbus record $adapter -o receiver.txt' \
  'build/sbus/sbus record /dev/ttyUSB0 -o receiver.txt'
check '( [0-9A-F]{2}){25}  frame end 00' 'build/sbus/sbus hex receiver.txt'
check '^([0-9]+,){17}[0-9]+$' 'make demo SOURCE=receiver.txt SKETCH=examples/AllChannels'
check '\(0 with errors\), [1-9][0-9]* frames$' 'rm receiver.txt; adapter --baud 200000
  timeout 60 build/sbus/sbus record $adapter -o receiver.txt --baud 200000' 'build/sbus/sbus record /dev/ttyUSB0 -o receiver.txt --baud 200000'
check 'build/host/Diagnose' 'make -C extras/host SKETCH=examples/Diagnose && ls build/host/Diagnose' 'make -C extras/host SKETCH=examples/Diagnose'
check '^Serial1 at 200000 baud, 8E2, inverted: .* [1-9][0-9]* good, 0 with errors$' \
  'build/host/Diagnose --source receiver.txt --baud 200000 --simulated-time' 'build/host/Diagnose --source receiver.txt --baud 200000'

check '^\| Fast S.Bus, dropped 1/300 \| T 7 ms, ' "make impairment FRAMES=50 SEED=7 FULL=1 ONLY='dropped 1/300' | tee full &&
  grep '^seed 7, 50 frames of each line' full && ! grep '^| ' full | grep -vE '^\| (line |---|.*dropped 1/300)'" \
  'make impairment' 'make impairment FRAMES=n' 'make impairment FULL=1' 'make impairment SEED=n' \
  "make impairment ONLY='dropped 1/300'"
check '^[{]"clean, odd 2F frames between", [{][1-9]' \
  'make -C test rates ONLY="odd 2F" && cat test/impairment/Rates.inc' 'make -C test rates'
check '\| [1-9][0-9]* \| 0 \| 0 \|$' "make impairment WITHOUT=falseSync FRAMES=200 ONLY='joined midway, short gaps'" 'make impairment WITHOUT=rule'
check 'FrameFinderFuzz: .* \(1 s, seed ' 'make fuzz SECONDS=1' 'make fuzz' 'make fuzz SECONDS=60'
check '^\| the longest call found: .*( \| [1-9][0-9]*){2} \|$' 'newlib && make bench' 'make bench'
check '^(ok figures: size|skipped figures: size, these compilers)' 'log figures "extras/docs/figures.sh check"' 'make size'
check '^ok package: make zip writes ' 'log package test/package.sh' 'make zip'
check '^ok package: make release sets ' 'log package test/package.sh' 'make release VERSION=x.y.z' \
  'make release VERSION=x.y.z URL=https://github.com/NAME/DecodeSBus' "make release VERSION=x.y.z MAINTAINER='NAME <ADDRESS>'"
check '^ok dist: SHA256SUMS has every file' 'log dist "echo skipped: the step dist has not run"' 'make dist'
check '^ok dist: sbus-[0-9.]*-linux-.*: it needs no library' 'log dist "echo skipped: the step dist has not run"' 'sudo tar xzf sbus-*-linux-x86_64.tar.gz -C /usr/local'

small
check '^[1-9][0-9]* passed, 0 failed$' "STEPS='captures|rules' make test-all V=1 CAPTURES=test/recordings | tee all &&
  grep '^ok captures/paper.txt, loop() of 50 us' all" 'make test-all' 'make test-all CAPTURES=dir' 'make test-all CAPTURES=folder' "STEPS='tool|bench' make test-all"
check '^[1-9][0-9]* passed, 0 failed$' "STEPS=rules make test V=1 SEED=7 | tee rules && grep '^1 steps with seed 7' rules &&
  grep '^ok impairment/RULES: ' rules" 'make test' 'make test V=1' 'make test SEED=n'
check '^10 passed, 0 failed$' 'make test ONLY=LinkTest'
check 'golden/DecodeSBus.csv$' 'rm test/golden/DecodeSBus.csv; make -C test golden-update && cmp test/golden/DecodeSBus.csv "$root/test/golden/DecodeSBus.csv"' \
  'make -C test golden-update'
check '[, ]10 frames of each line' 'newlib && make figures FRAMES=10 && cat extras/docs/measured.md' 'make figures'
check '^rm -rf build' 'make clean && [ ! -e build ]' 'make clean'

"$root/test/pages.py" commands README.md CONTRIBUTING.md extras/docs/maintaining.md recording help >names ||
  echo "FAILED commands: the pages cannot be read"
sort -t "$(printf '\t')" -k 2 -u names | while IFS="$(printf '\t')" read -r where command; do
  grep -qxF -e "$command" tested || echo "FAILED commands: $where names \"$command\", which no test runs: add it to test/commands.sh"
done
while read -r command; do
  cut -f2 names | grep -qxF -e "$command" || grep -qF -e "$command" "$root"/extras/docs/*.md || echo "FAILED commands: $command: no page names it: take it out of test/commands.sh"
done <tested
