#!/usr/bin/env bash
# Makes every figure whose table is there, and says which it skipped and why.
set -euo pipefail

usage() {
  cat <<'EOF'
Usage: scripts/figures.sh [--out DIR]
Draws the figures of paper_figs/ from tables that `relight run` left in out/NAME/table.csv or that are published in
results/NAME/table.csv; of two the one in out/ is taken. Needs python3-matplotlib.
  --out DIR   where figures go (default out/figures)
EOF
}

out=out/figures
while (($#)); do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --out) out=$(readlink -m "${2:?"--out needs a folder"}"); shift ;;
    *) echo "unknown option '$1'; valid: --out, --help" >&2; exit 2 ;;
  esac
  shift
done

cd "$(dirname "$(readlink -f "$0")")/.."
/usr/bin/python3 -c 'import matplotlib' 2>/dev/null || {
  echo "figures need matplotlib: apt-get install python3-matplotlib" >&2
  exit 1
}
mkdir -p "$out"
made=0 skipped=0 failed=0

# figure NAME EXPERIMENT SCRIPT [ARGUMENT...]: from the table of EXPERIMENT.
figure() {
  local name=$1 experiment=$2 script=$3 table='' folder why
  shift 3
  for folder in "out/$experiment" "results/$experiment"; do
    [[ -z $table && -f $folder/table.csv ]] && table=$folder/table.csv
  done
  if [[ -z $table ]]; then
    echo "skipped $name: neither out/$experiment/table.csv nor results/$experiment/table.csv is there (relight run experiments/$experiment.toml)"
    skipped=$((skipped + 1))
  elif why=$(/usr/bin/python3 "paper_figs/$script" "$table" "$out/$name.svg" "$@" 2>&1); then
    echo "made    $out/$name.svg from $table"
    made=$((made + 1))
  elif [[ $why == *Traceback* ]]; then
    printf 'FAILED  %s: %s\n' "$name" "$why" >&2
    failed=$((failed + 1))
  else
    echo "skipped $name: $why"
    skipped=$((skipped + 1))
  fi
}

for file in experiments/*.toml; do
  experiment=$(basename "$file" .toml)
  figure "accuracy_against_time_$experiment" "$experiment" accuracy_against_time.py
done
figure hasan2006_figure3 figure3 hasan2006_figure3.py
figure clustered_gather_sweeps clustered_gather_sweeps clustered_gather_sweeps.py
figure clustered_gather_figure2 clustered_gather_figure2 clustered_gather_figure2.py

waterfalls=(out/explain_error/*/waterfall.csv)
[[ -f ${waterfalls[0]} ]] || waterfalls=(results/explain_error/waterfalls/*.csv)
if [[ -f ${waterfalls[0]} ]]; then
  /usr/bin/python3 paper_figs/waterfall.py "${waterfalls[@]}" --out "$out/explain_error.svg"
  echo "made    $out/explain_error.svg from ${waterfalls[0]%%/explain_error/*}/explain_error"
  made=$((made + 1))
fi
for folder in out results; do
  table=$folder/hasan2006_table2/table.csv
  [[ -f $table ]] || continue
  /usr/bin/python3 paper_figs/hasan2006_table2.py "$table" >"$out/hasan2006_table2.md"
  echo "made    $out/hasan2006_table2.md from $table"
  made=$((made + 1))
  break
done
echo "$made made, $skipped skipped, $failed failed"
((failed == 0))
