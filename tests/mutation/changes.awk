# SPDX-License-Identifier: MIT
# Print every possible mutation of the given sources: FILE:LINE:COLUMN:LENGTH:REPLACEMENT.

function put(at, size, instead) { print FILENAME ":" FNR ":" at ":" size ":" instead }
# Return the line with quoted text and comments replaced by blanks.
function blanked(text) {
    while (match(text, /"([^"\\]|\\.)*"|\047([^\047\\]|\\.)+\047|\/\*.*\*\/|\/\*.*$/))
        text = substr(text, 1, RSTART - 1) sprintf("%" RLENGTH "s", "") substr(text, RSTART + RLENGTH)
    return text
}
function operators(code,    i, at, from) {
    for (i = 1; i <= pairs; i++)
        for (from = 1; (at = index(substr(code, from), old[i])) > 0; from += at)
            put(from + at - 1, length(old[i]), new[i])
}
function numbers(code,    from, at, word) {
    for (from = 1; match(substr(code, from), /[A-Za-z0-9_.]+/); from = at + length(word)) {
        at = from + RSTART - 1
        word = substr(code, at, RLENGTH)
        if (word !~ /^[0-9]+$/)
            continue
        put(at, length(word), word + 1)
        if (word > 0)
            put(at, length(word), word - 1)
    }
}
# Swap two adjacent arguments that are names, members or numbers.
function arguments(code,    from, at, pair, parts) {
    for (from = 1; match(substr(code, from), /(\(|, )[&*A-Za-z0-9_.>-]+, [&*A-Za-z0-9_.>-]+[,)]/); from = at + 1) {
        at = from + RSTART - 1
        pair = substr(code, at, RLENGTH - 1)
        at += pair ~ /^\(/ ? 1 : 2
        sub(/^(\(|, )/, "", pair)
        split(pair, parts, ", ")
        put(at, length(pair), parts[2] ", " parts[1])
    }
}
# Return the text in the parentheses that begin at a column, if they end on the same line.
function negation(code, at,    i, deep, c) {
    for (i = at; i <= length(code); i++) {
        c = substr(code, i, 1)
        deep += (c == "(") - (c == ")")
        if (deep == 0) {
            put(at, i - at + 1, "(!" substr($0, at, i - at + 1) ")")
            return
        }
    }
}
BEGIN {
    pairs = split(" < ~ <= ~ > ~ >= ~ == ~ != ~ && ~ || ~ + ~ - ~ * ~ / ~++~--~+=~-=~ << ~ >> ~ & ~ | ~ ^ ~ % ~|=~&=~true~false~break;~return -~(!~&& !~|| !~return !", old, "~")
    split(" <= ~ < ~ >= ~ > ~ != ~ == ~ || ~ && ~ - ~ + ~ / ~ * ~--~++~-=~+=~ >> ~ << ~ | ~ & ~ & ~ * ~&=~|=~false~true~continue;~return +~(~&& ~|| ~return ", new, "~")
}
FNR == 1 { in_comment = 0; previous = ";" }
in_comment { in_comment = !/\*\//; next }
/^ *#/ || /_Static_assert/ { next }
{
    code = blanked($0)
    in_comment = /\/\*/ && !/\*\//
    if (code ~ /^ *$/)
        next
    operators(code)
    numbers(code)
    arguments(code)
    if (match(code, /(if|while) \(/))
        negation(code, RSTART + RLENGTH - 1)
    # A statement that is all of a line, and neither declares nor returns something.
    if (code ~ /^ +[a-z_*(+-].*; *$/ && code !~ /^ +(const|static|return|typedef|for|if|while|do|[a-z_0-9]+ \*?[a-z_0-9]+( =.*|,.*|\[.*)?;)/ && previous ~ /([;{}:)]|else|do) *$/) {
        match(code, /[^ ]/)
        put(RSTART, length(code) - RSTART + 1, ";")
    }
    previous = code
}
