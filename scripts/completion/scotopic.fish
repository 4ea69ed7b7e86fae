# fish completion for scotopic: verbs and options are those of the program's help.
function __scotopic_verbs
    scotopic --help | sed -n '/^Subcommands:/,$s/^  \([a-z][a-z]*\)  *\(.*\)/\1\t\2/p'
end
function __scotopic_options
    scotopic (commandline -opc)[2] --help 2>/dev/null | sed -nE 's/^  (-[a-zA-Z],)?(--[a-z-]+).*/\2/p'
end
complete -c scotopic -n __fish_use_subcommand -f -a '(__scotopic_verbs)'
complete -c scotopic -n 'not __fish_use_subcommand; and string match -q -- "-*" (commandline -ct)' -f -a '(__scotopic_options)'
