#!/usr/bin/env bash
# upward_include.sh COMPILER INCLUDE_FOLDERS OWN ABOVE...: with these include folders (divided by
# ';') a source that includes the header OWN compiles, and one that includes a header of ABOVE does
# not, because it is not found.
set -euo pipefail
compiler=$1 own=$3
IFS=';' read -ra folders <<<"$2"
shift 3

compile() {
  echo "#include \"$1\"" |
    LC_ALL=C "$compiler" -std=c++20 -fsyntax-only "${folders[@]/#/-I}" -x c++ - 2>&1
}

if ! compile "$own"; then
  echo "$own was not found"
  exit 1
fi
for header in "$@"; do
  if said=$(compile "$header"); then
    echo "$header was found, and should not be"
    exit 1
  fi
  if [[ $said != *"$header"*[Nn]"o such file"* && $said != *"'$header' file not found"* ]]; then
    echo "$said"
    exit 1
  fi
done
