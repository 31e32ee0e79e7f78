#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compares two builds of muro on the scenes of scenes.txt, for `./dev bench --against`.
# usage: compare.sh OLD_SOURCE OLD_BUILD NEW_SOURCE NEW_BUILD [FILTER]
# The builds take turns, and the one that begins changes with each round. Prints for each scene the medians, the median
# of the ratios new to old, and half the distance of their quartiles. Exit code 1 when a scene has become slower by more
# than that and by 3 %; what one of the builds cannot run is named and left out.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
declare -A source=([old]=$1 [new]=$3) build=([old]=$2 [new]=$4)
filter=${5:-}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for which in old new; do
  mkdir "$scratch/$which"
  for control in steer chatter; do # one whose ports an old revision lacks is missing in its scene
    cc -O2 -shared -fPIC -I "${source[$which]}/sdk/c" "$here/$control.c" -o "$scratch/$which/$control.so" 2>/dev/null || true
  done
done

# Runs a scene with a build: prints the figure, or what went wrong.
measure() { # WHICH FIGURE ARGUMENTS...
  local which=$1 figure=$2 report=$scratch/report.json start
  shift 2
  [[ $figure != wall ]] || set -- "$@" --report "$report"
  start=${EPOCHREALTIME/./}
  if ! (cd "$here" && MURO_PLUGIN_PATH=${build[$which]}/lib/muro MURO_CONTROLLER_PATH=$scratch/$which \
    /usr/bin/time -o "$scratch/memory" -f %M "${build[$which]}/bin/muro" run "$@") \
    >"$scratch/output" 2>&1 </dev/null; then
    grep -m1 -E 'error|no ' "$scratch/output" || tail -n1 "$scratch/output"
    return 1
  fi
  case $figure in
    wall) sed -n 's/^ *"wall_s": *\([0-9.e+-]*\),\?$/\1/p' "$report" ;;
    start) awk "BEGIN { print (${EPOCHREALTIME/./} - $start) * 1e-6 }" ;;
    memory) awk '{ print $1 / 1024 }' "$scratch/memory" ;;
  esac
}

printf '%-40s %12s %12s %8s %8s\n' scene old new ratio +-
slower=()
while IFS='|' read -r name figure rounds arguments; do
  name=${name%"${name##*[! ]}"} figure=${figure// /} # without blanks at the end
  [[ $name != '#'* && -n $figure && $name == *"$filter"* ]] || continue
  read -ra arguments <<<"$arguments"
  pairs=() reason=''
  for ((round = 0; round < rounds; ++round)); do
    order=(old new)
    ((round % 2 == 0)) || order=(new old)
    declare -A seen
    for which in "${order[@]}"; do
      seen[$which]=$(measure "$which" "$figure" "${arguments[@]}") || { reason="$which build: ${seen[$which]}" && break 2; }
    done
    pairs+=("${seen[old]} ${seen[new]}")
  done
  if [[ -n $reason ]]; then
    printf '%-40s left out; %s\n' "$name" "$reason"
    continue
  fi
  line=$(printf '%s\n' "${pairs[@]}" | awk '
    function quantile(list, n, q,   at, low) {
      at = 1 + q * (n - 1); low = int(at)
      return low == n ? list[n] : list[low] + (at - low) * (list[low + 1] - list[low])
    }
    function sort(list, n,   i, j, x) {
      for (i = 2; i <= n; ++i) { x = list[i]; for (j = i - 1; j > 0 && list[j] > x; --j) list[j + 1] = list[j]; list[j + 1] = x }
    }
    { old[NR] = $1; new[NR] = $2; ratio[NR] = $2 / ($1 > 0 ? $1 : 1e-9) }
    END {
      sort(old, NR); sort(new, NR); sort(ratio, NR)
      middle = quantile(ratio, NR, 0.5); spread = (quantile(ratio, NR, 0.75) - quantile(ratio, NR, 0.25)) / 2
      printf "%.4g %.4g %.3f %.3f %s\n", quantile(old, NR, 0.5), quantile(new, NR, 0.5), middle, spread,
             (middle > 1 + (spread > 0.03 ? spread : 0.03) ? "slower" : "")
    }')
  read -r old new ratio spread verdict <<<"$line"
  unit=s
  [[ $figure != memory ]] || unit=MB
  printf '%-40s %12s %12s %8s %8s %s\n' "$name" "$old $unit" "$new $unit" "$ratio" "$spread" "$verdict"
  [[ -z $verdict ]] || slower+=("$name: $ratio times as much as before, with a spread of $spread")
done <"$here/scenes.txt"

((${#slower[@]} > 0)) || { echo "nothing is slower by more than its spread and 3 %" && exit 0; }
printf 'slower: %s\n' "${slower[@]}"
exit 1
