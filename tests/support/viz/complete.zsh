# SPDX-License-Identifier: MIT
# complete.zsh FILE <LINES: what zsh offers at the end of each line by the completions in a file, a line each, and then a
# line "--". They work in a shell that somebody types into alone, so one is started for each on a terminal of its own, and
# tells what it would offer. What it knows of all commands is kept for the next.
zmodload zsh/zpty
while IFS= read -r line; do
    zpty shell zsh -f -i
    zpty -w shell "PS1=; LISTMAX=-1; unsetopt zle_bracketed_paste; fpath=(${(q)1:a:h} \$fpath); autoload -U compinit
compinit -C -d ${(q)1:a:h}/known"
    zpty -w shell 'compadd() {
  local -a offered
  builtin compadd -A offered "$@"
  for one in $offered; do print -r -- "OFFERED:$one"; done
  builtin compadd "$@"
}
complete_and_tell() { zle complete-word; print -r -- "ALL-""TOLD" }
zle -N complete_and_tell; bindkey "^I" complete_and_tell; print -r -- "REA""DY"'
    zpty -r shell out '*READY*'
    zpty -w -n shell "$line"$'\t'
    zpty -r shell out '*ALL-TOLD*'
    print -r -- "$out" | tr -d '\r' | sed -n 's/.*OFFERED://p'
    print -- --
    zpty -d shell
done
