#!/usr/bin/env bash
# Configures and builds with all cores.
set -euo pipefail

usage() {
  cat <<'EOF'
Usage: scripts/build.sh [--preset NAME] [TARGET...]
Configures and builds relight in build/NAME with all cores; without targets everything, tests included.
  --preset NAME   release (default), native, debug, asan or tsan: see CMakePresets.json
EOF
}

preset=release
targets=()
while (($#)); do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --preset) preset=${2:?"--preset needs a name"}; shift ;;
    -*) echo "unknown option '$1'; valid: --preset, --help" >&2; exit 2 ;;
    *) targets+=(--target "$1") ;;
  esac
  shift
done

cd "$(dirname "$(readlink -f "$0")")/.."
mkdir -p build
log=build/configure-$preset.log
echo "Configuring build/$preset"
# Some hundred lines that matter only if something is wrong.
if ! cmake --preset "$preset" >"$log" 2>&1; then
  cat "$log" >&2
  echo "Configuring failed; the lines above are in $log" >&2
  exit 1
fi
echo "Building build/$preset with $(nproc) cores"
# [steps done/all, seconds so far]
export NINJA_STATUS="[%f/%t, %e s] "
cmake --build "build/$preset" --parallel "$(nproc)" "${targets[@]}"
