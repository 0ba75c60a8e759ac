# Completion for bash: of verbs, options, the words that options take, and files.

_sbus() {
  local verb word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words=
  verb=${COMP_WORDS[1]}
  local line="--baud --channels --sticks --silent --noise --uninverted"
  local source="$line --csv --seconds --simulated-time"
  if [ "$COMP_CWORD" -eq 1 ]; then
    words="ports monitor doctor hex csv plot record replay simulate decode wave --help --help-all --version"
  else
    case $before in
      --baud) words="100000 200000" ;;
      --channels) words="16 24 32" ;;
      --sticks) words="flight calibration" ;;
      --range) words="frsky futaba" ;;
      --color) words="auto always never" ;;
      --columns) words="ch1-ch4,failsafe,lostframe ch1-ch18 ch1-ch24 ch1-ch32 time state age" ;;
      --invert) words="yes no" ;;
      --noise | --seconds | --rate | --speed | --signal | --threshold) return ;;
      --to | --output | -o) ;;
      *)
        case $verb in
          monitor) words="$source --range" ;;
          doctor) words="$source" ;;
          hex) words="$source --color" ;;
          csv) words="$source --columns --rate --every-frame --header" ;;
          plot) words="$source --columns --output" ;;
          decode) words="--signal --baud --invert --rate --threshold --csv --json --characters" ;;
          wave) words="--output --baud --uninverted" ;;
          record) words="$source" ;;
          replay) words="--to --baud --speed --loop" ;;
          simulate) words="$line --to --seconds" ;;
        esac
        words="$words --help"
        case $verb in monitor | doctor | hex | csv | plot | record) words="$words sim" ;; esac
        ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  if [ "$COMP_CWORD" -gt 1 ] && [[ $word != -* ]] && { [ "$before" = --to ] || [ "$before" = --output ] || [ "$before" = -o ] || [[ $before != --* ]]; }; then
    COMPREPLY+=($(compgen -f -- "$word"))
    compopt -o filenames 2>/dev/null
  fi
}

complete -F _sbus sbus
