# zsh -f complete.zsh COMPLETION LINE: what an interactive zsh makes of LINE and the tabulator key.
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PS1=; autoload -U compinit; compinit -D -u; source ${(q)1}; print rea''dy"
zpty -r -m shell start '*ready*'
zpty -w -n shell "$2"$'\t'
for _ in {1..50}; do
  sleep 0.1
  while zpty -r -t shell part; do shown+=$part; done
  [[ $shown == *${2##* }[a-z]* ]] && break
done
print -r -- $shown
zpty -d shell
