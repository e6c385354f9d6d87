#!/usr/bin/env bash
# Tells which C++ files differ from .clang-format.
set -euo pipefail

usage() {
  cat <<'EOF'
Usage: scripts/format.sh [--fix]
Names the tracked C++ files that clang-format would change and exits with 1 if there are any.
  --fix   change them
EOF
}

fix=false
case "${1:-}" in
  --help | -h) usage; exit 0 ;;
  --fix) fix=true ;;
  "") ;;
  *) echo "unknown option '$1'; valid: --fix, --help" >&2; exit 2 ;;
esac

cd "$(dirname "$(readlink -f "$0")")/.."
mapfile -t files < <(git ls-files '*.cpp' '*.h')
if $fix; then
  clang-format -i "${files[@]}"
  exit 0
fi
differing=()
for file in "${files[@]}"; do
  clang-format --dry-run -Werror "$file" >/dev/null 2>&1 || differing+=("$file")
done
((${#differing[@]})) || exit 0
echo "${#differing[@]} of ${#files[@]} files differ from .clang-format (scripts/format.sh --fix changes them):"
printf '  %s\n' "${differing[@]}"
exit 1
