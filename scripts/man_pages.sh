#!/bin/sh
# Man pages from the help of the program and of each verb, by help2man.
#   scripts/man_pages.sh PROGRAM FOLDER
set -eu
program=$1 folder=$2
mkdir -p "$folder"
common=$folder/common.h2m
trap 'rm -f "$common"' EXIT
cat >"$common" <<'H2M'
[EXIT STATUS]
.TP
0
done
.TP
1
a check failed
.TP
2
the command line is wrong
.TP
3
an input is missing or damaged
.TP
4
a limit is exceeded
.TP
5
an output cannot be written; what was there before stays
.TP
6
a colour config, colour space or LUT is at fault
.TP
70
an error of the program
.TP
128+n
signal n ended it
.PP
Of a sequence: that of the first frame that failed.

[ENVIRONMENT]
.TP
OCIO
The OpenColorIO config, where \-\-config does not name one. A config may look at variables of its own.
H2M

# page NAME COMMAND: COMMAND's help as NAME.1, called NAME.
page() {
  text=$($2 --help | head -n 1)
  LC_ALL=C help2man --no-info --include="$common" --version-string="$("$program" --version)" --name="$text" "$2" |
    sed -e "s/^\\.TH SCOTOPIC /.TH $(echo "$1" | tr a-z A-Z) /" -e "s/^scotopic \\\\- /$1 \\\\- /" >"$folder/$1.1.new"
  mv "$folder/$1.1.new" "$folder/$1.1"
}

for verb in $("$program" --help | sed -n '/^Subcommands:/,$s/^  \([a-z][a-z]*\)  .*/\1/p'); do
  page "scotopic-$verb" "$program $verb"
done
page scotopic "$program"
