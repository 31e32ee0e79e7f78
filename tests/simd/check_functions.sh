#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_functions.sh FILE...: that no program or library of these takes an elementary function of the C library, whose
# last bit depends on the processor: muro/base/elementary.hpp and muro_elementary.h have those that are equal
# everywhere. Functions with exact results (sqrt, fmod, floor, ...) are free. Prints what takes which; exit code 1 then.
set -euo pipefail

functions='a?(sin|cos|tan)h?|atan2|sincos|exp(2|10|m1)?|log(2|10|1p)?|pow(10)?|cbrt|hypot|erfc?|[lt]?gamma|[jy][01n]'
# What other libraries bring along that are linked in; they have no say in state.
declare -A allowed=(
  [view_window]="acosf|atan2f|logf?|powf?|sincosf" # Dear ImGui
  [muro_parser_sdf]="sincos"                       # angles in headers of libsdformat; poses are quaternions by then
)

[[ $# -gt 0 ]] || { echo "usage: check_functions.sh FILE..." >&2 && exit 2; }
failures=0
for file in "$@"; do
  name=$(basename "$file" .so)
  found=$(nm --dynamic --undefined-only "$file" | sed -nE "s/^ +U (__)?(($functions)[fl]?)(_finite|_r)?(@.*)?$/\2/p" |
    sort -u | grep -vxE "${allowed[$name]:-^$}" | paste -sd' ' || true)
  [[ -n $found ]] || continue
  failures=1
  echo "$file: takes from the C library: $found"
done
exit $failures
