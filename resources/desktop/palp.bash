# Completion of palp and palp-studio in bash: commands and options as --help names them, so it cannot be out of date.

# _palpWords PROGRAM ...: the options that its --help lists.
_palpWords() {
  "$@" --help 2>/dev/null | grep -oE '^ +(-[a-zA-Z],)? ?--[a-z][a-z-]*' | grep -oE -- '--[a-z-]+'
}

_palp() {
  local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]}
  local commands
  if [ "$COMP_CWORD" -eq 1 ] && [ "${program##*/}" = palp ]; then
    commands=$("$program" --help 2>/dev/null | sed -nE '/^Subcommands:/,/^$/s/^  ([a-z]+) .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$commands --help --version" -- "$word")
  elif [[ $word == -* ]]; then
    case ${program##*/} in
    palp) mapfile -t COMPREPLY < <(compgen -W "$(_palpWords "$program" "${COMP_WORDS[1]}")" -- "$word") ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$(_palpWords "$program")" -- "$word") ;;
    esac
  fi
}
complete -o default -F _palp palp palp-studio
