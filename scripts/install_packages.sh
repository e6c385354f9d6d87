#!/usr/bin/env bash
# Installs the Debian packages of scripts/packages.txt that are missing.
set -euo pipefail

usage() {
  cat <<'EOF'
Usage: scripts/install_packages.sh [--tests] [--list]
Installs what is missing of scripts/packages.txt with apt, as root or through sudo. Does nothing if all is there.
  --tests  of scripts/test_packages.txt instead
  --list   print the missing packages, one a line, and install nothing
EOF
}

list_only=false
list=packages.txt
while (($#)); do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --tests) list=test_packages.txt ;;
    --list) list_only=true ;;
    *) echo "unknown option '$1'; valid: --tests, --list, --help" >&2; exit 2 ;;
  esac
  shift
done

here=$(dirname "$(readlink -f "$0")")

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "No apt here: make sure that the packages of scripts/$list are installed; CMake names what it misses." >&2
  exit 0
fi

missing=()
while read -r package _; do
  [[ -z $package || $package == \#* ]] && continue
  status=$(dpkg-query --show --showformat '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done <"$here/$list"

((${#missing[@]})) || exit 0
if $list_only; then
  printf '%s\n' "${missing[@]}"
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing and you are neither root nor have sudo. Ask someone who has to run:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${#missing[@]} missing packages: ${missing[*]}"
"${as_root[@]}" apt-get update -q
# Without recommended packages: they would triple the download.
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
