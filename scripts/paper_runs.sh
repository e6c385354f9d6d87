#!/usr/bin/env bash
# The full experiments behind the figures, one after the other.
set -euo pipefail

usage() {
  cat <<'EOF'
Usage: scripts/paper_runs.sh [--dry-run]
Runs every experiment in experiments/ but quick.toml into out/NAME, then makes the figures. Hours; what is done before is
not done again, so it can be stopped at any time and goes on where it was.
  --dry-run   list the runs and stop
EOF
}

dry=()
case "${1:-}" in
  --help | -h) usage; exit 0 ;;
  --dry-run) dry=(--dry-run) ;;
  "") ;;
  *) echo "unknown option '$1'; valid: --dry-run, --help" >&2; exit 2 ;;
esac

cd "$(dirname "$(readlink -f "$0")")/.."
failed=()
experiments=()
for file in experiments/*.toml; do
  [[ $(basename "$file") == quick.toml ]] || experiments+=("$file")
done
echo "${#experiments[@]} experiments; each begins with its list of runs. Stop and start again as you like."
for file in "${experiments[@]}"; do
  printf '\n== %s ==\n' "$file"
  build/release/bin/relight run "$file" --dry-run || { failed+=("$file"); continue; }
  ((${#dry[@]})) && continue
  # A run that fails must not keep the other experiments from starting.
  build/release/bin/relight run "$file" || failed+=("$file")
done
((${#dry[@]})) || scripts/figures.sh
if ((${#failed[@]})); then
  printf '\nFAILED: %s\n' "${failed[*]}" >&2
  exit 1
fi
