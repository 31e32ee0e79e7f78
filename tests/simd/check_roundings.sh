#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_roundings.sh FOLDER: that no plugin in the folder has an operation that multiplies and adds with one rounding,
# which a plain double of the oldest processors does not have. Prints where there is one; exit code 1 then.
set -euo pipefail

failures=0
for plugin in "$1"/*.so; do
  found=$(objdump --disassemble --no-show-raw-insn --demangle "$plugin" |
    awk '/^[0-9a-f]+ </ { name = $0; sub(/^[0-9a-f]+ /, "", name) } /\tvfn?m(add|sub)/ { print name }' | sort | uniq -c)
  [ -z "$found" ] && continue
  failures=1
  echo "$plugin: operations with one rounding in"
  echo "$found"
done
exit $failures
