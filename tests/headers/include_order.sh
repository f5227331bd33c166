#!/usr/bin/env bash
# include_order.sh ROOT: fails where a file of src or lab includes a folder that stands below its
# own in the table of docs/design.md, where files include each other in a circle, or where a source
# does not include the header of its name first; and where one of these, planted into a copy, is not
# found.
set -euo pipefail
root=$1

# "including included" for each include of ours in src and lab of the folder $1. Files as
# FOLDER/NAME.
includes() {
  (cd "$1" && grep -rHoE '^#include "[a-z_/.0-9]+' --include='*.h' --include='*.cpp' src lab) |
    sed -E 's/^(src|lab)\///; s|:#include "| |'
}

# Their folders in the order of the table.
folders=$(sed -nE 's/^\| `(src|lab)\/([a-z]+)` .*/\2/p' "$root/docs/design.md")

# Prints what is wrong with the modules in the folder $1, nothing where all is well.
faults() {
  includes "$1" | awk -v folders="$folders" '
    BEGIN { count = split(folders, name, "\n"); for (i = 1; i <= count; ++i) rank[name[i]] = i }
    {
      split($1, from, "/"); split($2, to, "/")
      if (!rank[from[1]]) print $1 ": docs/design.md does not name its folder"
      if (rank[to[1]] > rank[from[1]]) print $1 " includes " $2 ", which stands below it"
    }'
  # tsort fails where there is a circle, and names the files of it.
  includes "$1" | tsort 2>&1 >/dev/null | sed 's/^tsort: //; s/^-: input contains a/in a/' || true
  # By this the build shows that the header includes what it needs.
  # In lab/cli headers are included by their name alone.
  local folder
  for folder in src lab; do
    (cd "$1/$folder" && find . -name '*.h' ! -path './cli/*' -printf '%P\n') | while read -r header; do
      source=$1/$folder/${header%h}cpp
      [[ ! -f $source || $(grep -m1 '^#include' "$source") == "#include \"$header\"" ]] ||
        echo "${header%h}cpp does not include $header first"
    done
  done
}

found=$(faults "$root")
if [[ -n $found ]]; then
  echo "$found"
  exit 1
fi

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
# plant FILE INCLUDED WHAT [WHERE]: the same modules with one more include must be found at fault.
# It goes to WHERE as sed says it, by default after the last line.
plant() {
  rm -rf "$copy/src" "$copy/lab"
  cp -r "$root/src" "$root/lab" "$copy"
  sed -i "${4:-\$a} #include \"$2\"" "$copy/$1"
  if [[ $(faults "$copy") != *"$3"* ]]; then
    echo "$1 with an include of $2 was not found at fault"
    exit 1
  fi
}
plant src/rig/rig.h style/model/model.h 'rig/rig.h includes style/model/model.h, which stands below it'
plant src/learn/take.h train/trainer.h 'learn/take.h includes train/trainer.h, which stands below it'
plant src/base/vec.h base/quat.h 'in a loop'
plant src/rig/mapping.cpp rig/rig.h 'rig/mapping.cpp does not include rig/mapping.h first' 1i
plant lab/eval/ood.cpp eval/shot.h 'eval/ood.cpp does not include eval/ood.h first' 1i
