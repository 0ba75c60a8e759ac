#compdef sbus
# Completion for zsh; `sbus __complete` knows the words.

local found
for found in ${(f)"$(${~words[1]} __complete "${(@)words[2,CURRENT]}" 2>/dev/null)"}; do
  if [[ $found = :files ]]; then
    _files
  else
    compadd -- "$found"
  fi
done
