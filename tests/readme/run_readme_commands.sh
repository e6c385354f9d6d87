#!/usr/bin/env bash
# Runs every command in the README's ```sh blocks. Red if one is misspelt, lost its option or ends with an error.
# Changed before running: full-size views, clouds, fits and the largest scene become small, since a test must not take an
# hour, and ./reproduce and ./check are run with --help only (this test is part of ./check).
# usage: run_readme_commands.sh SOURCE_DIR RELIGHT_BINARY
set -euo pipefail

source_dir=$1
binary=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export RELIGHT_CACHE=$work/cache
export RELIGHT_SHARED_SCENES=${RELIGHT_SHARED_SCENES:-$source_dir/../shared/scenes}
ln -s "$source_dir"/{scenes,experiments,reference,reproduce,check} "$work"
cd "$work"

# Lines of the ```sh blocks, with continued lines joined.
mapfile -t commands < <(awk '/^```sh$/ {on = 1; next} /^```/ {on = 0} on' "$source_dir/README.md" |
  sed -e ':a' -e '/\\$/ { N; s/\\\n */ /; ba' -e '}' -e '/^ *#/d' -e '/^ *$/d')

ran=0
skipped=0
for command in "${commands[@]}"; do
  case "$command" in
    ./reproduce* | ./check*) small="${command%% *} --help" ;;
    git\ clone* | cd\ *) continue ;;
    *) small=$(sed -E -e 's/--view [0-9]+x[0-9]+/--view 48x36/' -e 's/gather_samples=[0-9]+/gather_samples=1024/' \
         -e 's/refit_lights=[0-9]+/refit_lights=16/' -e 's/--scene temple/--scene temple:detail=0.3/' \
         -e 's/--reference-samples [0-9]+/--reference-samples 8/' -e 's/--samples [0-9]+/--samples 8/' \
         -e "s#build/release/bin/relight#$binary#" <<<"$command") ;;
  esac
  if [[ $small == *scenes/*.toml* && ! -d $RELIGHT_SHARED_SCENES/scenes ]]; then
    echo "SKIPPED (the folder of real scenes is missing: $RELIGHT_SHARED_SCENES): $command"
    skipped=$((skipped + 1))
    continue
  fi
  if [[ $small == *compare*direct_to_indirect* && $small != *gather_samples* ]]; then
    small+=" --set direct_to_indirect.gather_samples=1024"
  fi
  if [[ $small == *--preset\ best* ]]; then
    small+=" --set direct_to_indirect.refit_lights=16"
  fi
  echo "+ $small"
  if ! bash -c "$small" >"$work/output.txt" 2>&1; then
    cat "$work/output.txt"
    echo "README command failed: $command" >&2
    exit 1
  fi
  ran=$((ran + 1))
done

# A README without commands would pass the loop.
if ((ran < 8)); then
  echo "only $ran commands found in README.md; the blocks must be marked \`\`\`sh" >&2
  exit 1
fi
echo "$ran commands of the README ran, $skipped skipped"
