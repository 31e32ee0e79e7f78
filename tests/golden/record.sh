#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# record.sh [BUILD]: writes the files of hashes anew, of the runs that they list, with what a build computes (default:
# build). Look at what changed before you commit it.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(cd "$here/../.." && pwd)
build=$(realpath "${1:-$tree/build}")
export MURO_PLUGIN_PATH=$build/lib/muro MURO_CONTROLLER_PATH=$build/tests/golden
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for hashes in "$here"/*.hashes; do
  sed '/^[^#]/,$d' "$hashes" >"$scratch/new" # the comment at the head
  while read -r scenario duration third; do
    [[ -n $scenario && $scenario != '#'* && -z $third ]] || continue
    "$build/tests/property_hashes" "$tree/$scenario" --by-key --duration "$duration" --out "$scratch/run.json"
    drawn='^$'
    [[ $scenario != *sensors* ]] || drawn='^(camera\.|ranges|laser\.)'
    {
      echo "$scenario $duration"
      sed -nE 's/^ *"([^"]+)": "([^"]+)",?$/\1 \2/p' "$scratch/run.json" | grep -vE "$drawn"
      echo
    } >>"$scratch/new"
  done <"$hashes"
  cp "$scratch/new" "$hashes"
done
