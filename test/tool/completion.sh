#!/bin/bash
# Completes command lines, and says "ok ..." or "FAILED ..." of:
#   every subcommand and option that --help-all lists
#   tool/COMPLETIONS, by bash, zsh and fish
# WORDS: a file, a subcommand and an option a line.
set -u
cd "$(dirname "$0")/.." || exit 1
export PATH="${SBUS%/*}:$PATH"
completions=$PWD/../extras/cli

. tool/common.sh

# Each prints the completions of its last argument, a command line.
complete_bash() {
  bash -c '. "$0/completion.bash"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _sbus sbus; printf "%s\n" "${COMPREPLY[@]}"' \
    "$completions" "$@"
}
complete_zsh() {
  zsh -f -c 'fpath=("$0"); autoload -Uz _sbus; compadd() { print -r -- "${@[2,-1]}" }; _files() { print -rl -- * }
    words=("$@"); CURRENT=$#; _sbus' "$work/zsh" "$@"
}
complete_fish() {
  fish --no-config -c 'source $argv[1]/completion.fish; complete -C (string join " " -- $argv[2..-1])' "$completions" "$@"
}

failed=0
while read -r subcommand option; do
  complete_bash sbus $subcommand ${option:+"$option"} | grep -qxFe "${option:-$subcommand}" ||
    { echo "$subcommand $option is not completed"; failed=1; }
done <"$WORDS"
verdict $failed "every subcommand and option is completed"

mkdir -p "$work/zsh" "$work/here"
cp "$completions/completion.zsh" "$work/zsh/_sbus"
touch "$work/here/flight 1.txt" "$work/here/receiver.vcd"
"$SBUS" ports 2>/dev/null | sed -n 's,^\(/dev/[^ ]*\).*,\1,p' >"$work/ports"
grep -v '^#' tool/COMPLETIONS >"$work/completions"
for shell in bash zsh fish; do
  command -v $shell >/dev/null || { echo "skipped sbus: completion by $shell, which is not here"; continue; }
  while IFS= read -r line; do
    begun=${line% =*}
    read -r -a words <<<"sbus $begun"
    [[ $begun =~ (^|\ )$ ]] && words+=("")
    for each in ${line##* =}; do
      case $each in
        '<ports>') cat "$work/ports" ;;
        '<files>') ls "$work/here" ;;
        *) echo "$each" ;;
      esac
    done | sort >"$work/wanted"
    (cd "$work/here" && complete_$shell "${words[@]}") 2>&1 | sed 's/\t.*//; /^$/d' | sort >"$work/got"
    diff "$work/wanted" "$work/got"
    verdict $? "$shell completes: sbus $begun"
  done <"$work/completions"
done
