# SPDX-License-Identifier: MIT
# complete.fish FILE <LINES: what fish offers at the end of each line by the completions in a file, a line each, and then a
# line "--".
source $argv[1]
while read --local line
    complete -C "$line" | string replace -r '\t.*' ''
    printf '%s\n' --
end
