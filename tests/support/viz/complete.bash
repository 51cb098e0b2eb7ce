# SPDX-License-Identifier: MIT
# complete.bash FILE <LINES: what bash offers at the end of each line by the completions in a file, a line each, and then a
# line "--".
source "$1"
while IFS= read -r line; do
    read -ra COMP_WORDS <<<"${line//=/ = }" # it ends words
    [[ $line != *' ' ]] || COMP_WORDS+=('')
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _octreel
    printf '%s\n' "${COMPREPLY[@]}" --
done
