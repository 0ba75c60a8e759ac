# Completion for fish; `sbus __complete` knows the words.

function __sbus_complete
    set -l words (commandline -opc)
    set -l word (commandline -ct)
    for found in ($words[1] __complete $words[2..-1] "$word" 2>/dev/null)
        if test "$found" = :files
            __fish_complete_path "$word"
        else
            echo $found
        end
    end
end

complete -c sbus -f -a '(__sbus_complete)'
