#!/bin/sh
# Runs `sbus monitor` in terminals of tmux, and says "ok ..." or "FAILED ..." of:
#   tool/pages/NAME.txt   what is on the page, for each call of `page` below
#   keys, another size, a line that falls silent, and the terminal afterwards
# "pages.sh update" writes tool/pages instead.
set -u
cd "$(dirname "$0")/.." || exit 1
update="${1:-}"
server=0

. tool/common.sh

# Each terminal has its own server, since a server that is ending accepts no more terminals.
tmux() { command tmux -S "$work/tmux-$server" -f /dev/null "$@"; }

# open SIZE COMMAND: a terminal of that size, and a shell command in it
open() {
  server=$((server + 1))
  tmux -u new-session -d -x "${1%x*}" -y "${1#*x}" "env PATH='$PATH' $2" \; set -g status off
}

close() { tmux kill-server 2>/dev/null; }

# shows TEXT: the page has it within a minute
shows() {
  until_true has "$1" || { echo "not on the page: $1"; cat "$work/page.txt"; return 1; }
}
has() { tmux capture-pane -p >"$work/page.txt" 2>&1 && grep -qF -e "$1" "$work/page.txt"; }

# same NAME: the page becomes tool/pages/NAME.txt within a minute
same() {
  if [ "$update" = update ]; then
    shows ENDED && cp "$work/page.txt" "tool/pages/$1.txt"
    return
  fi
  until_true is "$1" || { diff "$work/page.txt" "tool/pages/$1.txt"; return 1; }
}
is() { tmux capture-pane -p >"$work/page.txt" && cmp -s "$work/page.txt" "tool/pages/$1.txt"; }

# page NAME SIZE ENVIRONMENT ARGUMENTS...: checks the page at the end of a line
page() {
  name=$1 size=$2 environment=$3
  shift 3
  open "$size" "env $environment '$SBUS' monitor $* --simulated-time" && same "$name"
  verdict $? "monitor $* in $size, $environment, shows its page"
  close
}

# ---- What is on the page

utf8=LC_ALL=C.UTF-8
page failsafe 80x24 $utf8 sim --seconds 10.5
page failsafe-small 40x12 $utf8 sim --seconds 10.5
page failsafe-plain 80x24 'LC_ALL=C TERM=vt100' sim --seconds 10.5
page channels24 120x36 $utf8 sim:24 --seconds 3.2
page channels32-small 40x12 $utf8 sim:32 --seconds 3.2
page noise 120x30 $utf8 sim:noise=100 --seconds 3.2
page futaba 80x24 $utf8 recordings/sbus2.txt --range futaba
page sensors 80x24 $utf8 sim:sbus2 --sensor 1=SBS-01V --seconds 3.2
page silent 80x24 $utf8 sim:silent --seconds 2
page sketch 80x24 $utf8 golden/DecodeSBus.csv
page unknown-rows 80x24 $utf8 golden/Normalized.csv
[ "$update" = update ] && exit

for file in tool/pages/*.txt; do
  grep -q "^page $(basename "$file" .txt) " tool/pages.sh || verdict 1 "a call of page has $file"
done
[ "$(awk '$1 ~ /^[0-9]+$/ && NF > 6 { printf "%s%s", comma, $2; comma = "," }' tool/pages/failsafe.txt)" = \
  "$("$SBUS" csv sim --simulated-time --seconds 10.5 --columns ch1-ch16 | tail -n 1)" ]
verdict $? "the raw values of tool/pages/failsafe.txt are those of csv"

cp recordings/paper.txt "$work/飛行の記録ポート.txt"
open 80x24 "sh -c \"cd '$work'; LC_ALL=C.UTF-8 '$SBUS' monitor 飛行の*.txt --simulated-time\"" && shows ' 飛行の記録ポート.txt   S.BUS, 100000 baud                              ● stale'
verdict $? "a name of wide characters leaves room for the state"
close

# colours WANTED ENVIRONMENT: checks whether the page has colours
colours() {
  open 80x24 "env LC_ALL=C.UTF-8 $2 '$SBUS' monitor sim --simulated-time --seconds 10.5" && shows Failsafe: &&
    [ "$(tmux capture-pane -pe | grep -c "$(printf '\033')\\[[0-9;]*4[1-7]m.*Failsafe:")" = "$1" ]
  verdict $? "the banner is red: $1, with $2"
  close
}
colours 1 TERM=screen-256color
colours 0 'TERM=screen-256color NO_COLOR=1'
colours 0 TERM=vt100

# ---- Keys and sizes

open 80x24 "env $utf8 '$SBUS' monitor sim --simulated-time --seconds 10.5" && same failsafe &&
  tmux resize-window -x 40 -y 12 && same failsafe-small &&
  tmux resize-window -x 30 -y 8 && shows 'needs 40x12, has 30x8' &&
  tmux resize-window -x 1 -y 1 && tmux resize-window -x 300 -y 100 && shows 'ENDED: q quits' &&
  tmux resize-window -x 80 -y 24 && same failsafe
verdict $? "the page follows the terminal's size"
is_cut() { has 'reset marks' && ! has 'and counters'; }
tmux send-keys '?' && shows 'reset marks and counters' && tmux resize-window -x 30 -y 8 && until_true is_cut &&
  tmux resize-window -x 80 -y 24 && shows 'reset marks and counters' && tmux send-keys x && same failsafe &&
  tmux send-keys r && shows 'lost by radio 0' && shows 'gap -' && shows 'Failsafe:'
verdict $? "? shows help, also in another size; r resets marks and counters, but not the link's state"
close

open 80x24 "env $utf8 '$SBUS' monitor sim" && shows ' ok' && tmux send-keys Space && shows PAUSED &&
  cp "$work/page.txt" "$work/paused.txt" && sleep 0.3 && shows PAUSED && cmp "$work/page.txt" "$work/paused.txt" &&
  tmux send-keys Space && shows 'q quit ' && shows '111 frames/s'
verdict $? "space pauses"
close

# The recording grows while the page is shown, and is complete after q.
open 160x24 "sh -c 'env $utf8 \"$SBUS\" monitor sim -o \"$work/seen.txt\"; echo back; sleep 1000'" && shows ' ok'
until_true has_lines 101 "$work/seen.txt"
tmux send-keys q && shows back && shows "seen.txt: " && shows ' frames' && [ -z "$(tail -c 1 "$work/seen.txt")" ] &&
  frames=$("$SBUS" hex "$work/seen.txt" | grep -c '  frame end 00') && [ "$frames" -gt 90 ] && grep -q "(0 with errors), $frames frames" "$work/page.txt"
verdict $? "monitor -o works while the page is shown"
close

# ---- The terminal afterwards

for end in q INT TERM; do
  rm -f "$work/before" "$work/after"
  open 80x24 "sh -c 'echo here it was; stty -g >\"$work/before\"; \"$SBUS\" monitor sim; echo \$? >\"$work/status\"; stty -g >\"$work/after\"; echo; echo back; sleep 1000'"
  shows ' ok'
  if [ $end = q ]; then tmux send-keys q; else kill -$end "$(tmux display -p '#{pane_pid}' | xargs pgrep -P | head -n 1)"; fi
  shows back && shows 'here it was' && cmp "$work/before" "$work/after" && [ "$(cat "$work/status")" = 0 ] &&
    [ "$(tmux display -p '#{alternate_on}#{cursor_flag}')" = 01 ]
  verdict $? "the terminal is restored after $end"
  close
done

for source in sim "'$PWD/recordings/paper.txt'"; do
  open 80x24 "sh -c \"'$SBUS' monitor $source --seconds 1.5; echo it ended: \\$?; sleep 1000\"" && shows 'it ended: 0'
  verdict $? "monitor $source ends after --seconds, in real time"
  close
done
close

# ---- A real line

"$SBUS" send sim >"$work/terminal" 2>"$work/player.err" &
player=$!
until_true has_terminal
open 80x24 "env $utf8 '$SBUS' monitor '$terminal'" && shows ' ok' && kill -STOP $player &&
  shows 'Stale: no frame for' && shows ' 992 1500' && kill -CONT $player && shows ' ok'
verdict $? "a silent line is stale, with its last values, until frames come again"
kill $player && shows 'the program at the other end is gone' && shows ' 992 1500'
verdict $? "the page says that its port is gone"
wait $player
close
