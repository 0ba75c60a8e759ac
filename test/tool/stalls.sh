#!/bin/sh
# Stops and kills parts of a line that passes through `sbus`, and says "ok ..." or "FAILED ..." of what leaves it: no frame
# older than 0.1 s without the failsafe flag, and none that is cut.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh
WORK=$work
export WORK

while IFS='|' read -r case what; do
  # shellcheck disable=SC2086  # the case is words
  figures=$(timeout 120 python3 tool/stalls.py "$SBUS" $case 2>&1)
  status=$?
  [ $status -eq 0 ] || cat "$work/stalls.err"
  verdict $status "$what: $figures"
done <<'END'
stop fly 0|bridge, a program and send, bridge stopped for 2 s
stop fly 1|bridge, a program and send, the program stopped
stop fly 2|bridge, a program and send, send stopped
stop own 1|bridge, a program whose frames do not say when they were read, and send; the program stopped
stop jq 0|hex --json, jq and send, hex stopped
stop jq 1 60|hex --json, jq and send, jq stopped for 0.5 s
stop jq 2|hex --json, jq and send, send stopped
stop record 0|record and send, record stopped
stop record 1|record and send, send stopped
stop rows 0|rows of csv and send, csv stopped
stop rows 1|rows of csv and send, send stopped
stop cat 0|bytes through a pipe, their writer stopped
stop cat 1 600|bytes through a pipe, bridge stopped for 6 s
stop bytes 1|bytes through a pipe, send stopped
stop bridge 0|bridge from port to port, stopped
stop send 0|send from port to port, stopped
queue|bridge stopped while a frame waits for its gap
full bridge|a device that takes no bytes for 3 s, after bridge; the frame that was fresh when it was written is read
full jq|a device that takes no bytes for 3 s, after send
slow bridge 25 0.012|a device that reads 25 bytes every 12 ms, after bridge
slow send 25 0.012|a device that reads 25 bytes every 12 ms, after send
slow bridge 10 0.005|a device that reads 10 bytes every 5 ms
times hex --json|hex --json stopped for up to 3 s
times csv --every-frame --header --columns time,ch1-ch16|csv --every-frame stopped for up to 3 s
kill fly 0|bridge of three programs is killed
kill fly 1|a program between bridge and send is killed
kill jq 0|hex of three programs is killed
kill jq 1|jq of three programs is killed
kill cat 0|the writer of bytes is killed
vanish bridge|the receiver of bridge vanishes
vanish send|the receiver of send vanishes
vanish jq|the receiver of three programs vanishes
vanish record|the receiver of record, for send, vanishes
vanish cat|the writer of bytes loses its receiver
lose bridge|the device of bridge vanishes
lose send|the device of send vanishes
lose jq|the device of three programs vanishes
END
