#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# usage: check.sh [FILE...]
# Finds comments that a reader in a second language would read twice: those that begin with a word that has no noun
# or verb behind it yet, and phrases of which plainer ones exist. Prints file:line and what to write; exit code 1 if any.
set -euo pipefail
cd "$(dirname "$0")/../.."

files=("$@")
((${#files[@]} > 0)) || mapfile -t files < <(git ls-files -co --exclude-standard '*.c' '*.h' '*.cpp' '*.hpp' | xargs ls -d 2>/dev/null)

awk '
  function report(what) { print FILENAME ":" FNR ": " what; found = 1 }
  FNR == 1 { in_block = 0 }
  {
    at = match($0, /(^|[ \t;{}(),])\/\/\/?<?( |$)/)
    if (at == 0) { in_block = 0; next }
    comment = substr($0, at)
    sub(/^[^\/]*\/\/\/?<? ?/, "", comment)
    whole_line = $0 ~ /^[ \t]*\/\/\/?( |$)/
    if (comment ~ /SPDX-License|NOLINT/) { in_block = 0; next }
    if (whole_line && !in_block && match(comment, /^(Of|As|Likewise|Who|Which|By|Null|That|Those|The same) /))
      report("a comment begins with `" substr(comment, 1, RLENGTH - 1) "`; begin with a noun, or with a verb: Returns, Holds")
    in_block = whole_line
    text = " " tolower(comment) " "
    if (text ~ /[^a-z]told[^a-z]/) report("`told`: say reported, given, named or commanded")
    if (text ~ /[^a-z]tells? of[^a-z]/) report("`tell of`: say reports")
    if (text ~ /[^a-z]has it not[^a-z]/) report("`has it not`: say does not have it")
    if (text ~ /wildness/) report("`wildness`: say limit ratio")
    if (text ~ /must bear/) report("`must bear`: say withstands")
    if (text ~ /one behind the other/) report("`one behind the other`: say in order, or one after the other")
    if (text ~ /[^a-z]likewise[^a-z]/) report("`likewise`: repeat the verb")
  }
  END { exit found }' "${files[@]}"
