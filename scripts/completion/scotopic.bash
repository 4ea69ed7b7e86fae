# bash completion for scotopic. It asks the program: verbs and options are those of its help, values of an option those
# that the program names when it is given one that it cannot know.
_scotopic_words() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} program=${COMP_WORDS[0]} verb=${COMP_WORDS[1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    local verbs
    verbs=$("$program" --help 2>/dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z][a-z]*\)  .*/\1/p')
    COMPREPLY=($(compgen -W "$verbs --help --version" -- "$word"))
    return
  fi
  local help kind asked values
  help=$("$program" "$verb" --help 2>/dev/null)
  if [[ $before == -* ]]; then
    # What stands after an option's name: the kind of its value, in capitals; nothing for a flag.
    kind=$(sed -nE "s/^  (-[a-zA-Z],)?(.*,)?${before}(,--[a-z-]+)? ([A-Z]{2,}[^ ]*|[A-Z])( .*)?$/\4/p" <<<"$help")
    case $kind in
      NAME | TYPE | WHAT)
        case $verb in
          apply | lmsr) asked=(no/such/file -o no/such/folder/out.exr) ;;
          explain) asked=(no/such/file) ;;
          bake) asked=(-o no/such/folder/out.clf --adaptation 1) ;;
          *) return ;;
        esac
        values=$("$program" "$verb" "${asked[@]}" "$before" '?' 2>&1 >/dev/null |
          sed -n "s/.*'?' is not one of \([^()]*\).*/\1/p")
        COMPREPLY=($(compgen -W "${values//,/}" -- "$word"))
        return ;;
      '' | *FILE* | *IN* | *OUT* | *DIR* | *CONFIG*) ;;
      *) compopt +o default 2>/dev/null; return ;; # a number: no file is offered
    esac
  fi
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$(sed -nE 's/^  (-[a-zA-Z])?,?(--[a-z-]+)?.*/\1 \2/p' <<<"$help")" -- "$word"))
  fi
}
complete -o default -F _scotopic_words scotopic
