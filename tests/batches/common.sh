# Sourced with the program as its argument: a folder of 40 short clips to restyle, in which the script
# goes on; recipe NAME prints a recipe of docs/batches.md, check_all checks its results.
program=$(realpath "$1")
docs=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../docs/batches.md")
work=$(mktemp -d)
stop=("rm -rf '$work'")
trap 'for ((i = ${#stop[@]} - 1; i >= 0; --i)); do eval "${stop[i]}" || true; done' EXIT
cd "$work"
mkdir -p bin takes/walks
ln -s "$program" bin/panache
export PATH=$work/bin:$PATH
export PANACHE_MODEL=$(realpath "$(dirname "$docs")/../models/panache-int8.safetensors")
panache walker -o takes/walks/1.bvh --seconds 2 >/dev/null
for ((i = 2; i <= 40; ++i)); do cp takes/walks/1.bvh "takes/walks/$i.bvh"; done

# The block of code below the line "<!-- recipe: NAME -->".
recipe() {
  awk -v mark="<!-- recipe: $1 -->" '
    $0 == mark { found = 1 } found && /^```/ { if (open) exit; open = 1; next } open { print }' "$docs"
}

# Each clip is restyled once, by more than one process, and its report says so.
check_all() {
  local made done_ shards
  made=$(find styled -name '*.bvh' | wc -l)
  done_=$(cat reports/*.jsonl | grep -c '"ok":true,"skipped":false')
  shards=$(find reports -name '*.jsonl' -size +1k | wc -l)
  echo "$made files, $done_ lines of reports, $shards reports"
  [[ -f styled/walks/7.bvh ]] && ((made == 40 && done_ == 40 && shards > 1))
}
