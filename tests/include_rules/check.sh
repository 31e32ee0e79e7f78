#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check.sh [TREE [RULES]]: holds the includes and links of a source tree (default: this one) against rules (default:
# rules.txt), and that core names no plugin; rules name folders that exist. Prints what breaks a rule, one line each;
# exit code 1 when something does.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
rules=$(realpath "${2:-$here/rules.txt}")
cd "${1:-$here/../..}"

declare -a library_names=() library_begins=()               # parallel: one entry a beginning
declare -a folder_regexes=() folder_allows=() folder_for=() # parallel: one entry a rule
declare -a link_folders=() link_targets=()
while read -r word name rest; do
  case $word in
    '' | '#'*) ;;
    library) for begin in $rest; do library_names+=("$name") library_begins+=("$begin"); done ;;
    folder | tests) folder_regexes+=("^(${name//\*/[^/]+})/") folder_allows+=("$rest") folder_for+=("$word") ;;
    link) link_folders+=("$name") link_targets+=("$rest") ;;
    *) echo "$rules: '$word' is none of library, folder, tests, link" >&2 && exit 2 ;;
  esac
done <"$rules"

failures=0
fail() {
  echo "$1"
  failures=$((failures + 1))
}

# What `file` includes by `name`: a path of this tree, a library's name, or nothing. Result in `target`.
resolve() {
  local file=$1 name=$2 i folder=${1%/*}
  if [[ $name != */* && $name != *.* ]]; then
    target=std
    return
  fi
  # a folder of the file, or one above it, is where its own includes start
  while [[ $folder == */* && ! -f $folder/$name ]]; do folder=${folder%/*}; done
  if [[ -f $folder/$name ]]; then
    target=$folder/$name
    [[ $target != *..* ]] || target=$(realpath -m --relative-to=. "$target")
  elif [[ $name =~ ^(muro|describe)/ && -f sdk/$name ]]; then
    target=sdk/$name
  elif [[ $name == muro_*.h* && -f sdk/c/$name ]]; then
    target=sdk/c/$name
  elif [[ -f $name ]]; then
    target=$name
  else
    target=
    for i in "${!library_begins[@]}"; do
      [[ $name != "${library_begins[i]}"* ]] || target=${library_names[i]}
    done
  fi
}

# What the rules allow to `file`: folders and libraries. Result in `allowed`.
allowance() {
  local file=$1 i
  allowed=std
  for i in "${!folder_regexes[@]}"; do
    [[ $file =~ ${folder_regexes[i]} ]] || continue
    local own=${BASH_REMATCH[1]} words=" ${folder_allows[i]} " family
    family=${own%/*}/common
    [[ -d $family ]] || family=
    [[ ${folder_for[i]} == folder || $file =~ (_test\.cpp|_testing\.hpp|/bench_[^/]*\.cpp)$ ]] || continue
    words=${words/ own / $own }
    allowed+=${words/ family / $family }
  done
}

check_includes() {
  local folders=() words=() folder file line text target allowed word of=
  for folder in sdk core host plugins examples tests; do [[ ! -d $folder ]] || folders+=("$folder"); done
  while IFS=: read -r file line text; do
    [[ $text =~ include[[:space:]]*[\"\<]([^\">]+) ]] || continue
    local name=${BASH_REMATCH[1]}
    resolve "$file" "$name"
    [[ $file == "$of" ]] || allowance "$file" # includes of a file follow each other
    of=$file
    if [[ -z $target ]]; then
      fail "$file:$line: includes \"$name\", of no library that tests/include_rules/rules.txt knows; add it there"
      continue
    fi
    for word in $allowed; do
      [[ $target != "$word" && $target != "$word"/* ]] || continue 2
    done
    read -ra words <<<"$allowed"
    fail "$file:$line: includes \"$name\" ($target); this file may include: ${words[*]}"
  done < <(grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.[ch]' --include='*.[ch]pp' "${folders[@]}" | sort -t: -k1,1 -k2n)
}

check_links() {
  local i file target code
  for i in "${!link_folders[@]}"; do
    [[ -d ${link_folders[i]} ]] || continue
    while read -r file; do
      code=$(sed 's/#.*//' "$file" | tr '\n' ' ' | sed -E 's/muro_add_(test|bench)\([^()]*\)//g')
      for target in ${link_targets[i]}; do
        [[ ! $code =~ (^|[^a-z_])$target([^a-z_]|$) ]] ||
          fail "$file: names $target; under ${link_folders[i]}/ only muro_add_test and muro_add_bench may link it"
      done
    done < <(find "${link_folders[i]}" -name CMakeLists.txt | sort)
  done
}

# The core knows plugins by what they describe, never by name.
check_core_names_no_plugin() {
  [[ -d core && -d plugins ]] || return 0
  local names file line text
  names=$({
    grep -rhoE '\.id = "[a-z0-9_.]+"' --include='*.cpp' plugins | grep -oE '"[^"]+"' | tr -d '"' || true
    grep -rhoE 'muro_add_plugin\([[:space:]]*NAME[[:space:]]+[a-z0-9_]+' --include=CMakeLists.txt plugins |
      sed 's/.*[[:space:]]//' || true
  } | sort -u | sed 's/\./\\./g' | paste -sd'|')
  [[ -n $names ]] || return 0
  while IFS=: read -r file line text; do
    [[ ! ${text%%//*} =~ \"($names)\" ]] || fail "$file:$line: names the plugin \"${BASH_REMATCH[1]}\"; core knows no plugin by name"
  done < <(grep -rnE "\"($names)\"" --include='*.[ch]pp' core | sort -t: -k1,1 -k2n)
}

# A rule for a folder that is gone says something of a layout that is gone.
check_rules_name_folders() {
  local i regex folders
  folders=$(find . -type d -printf '%P/\n')
  for i in "${!folder_regexes[@]}"; do
    regex=${folder_regexes[i]}
    grep -qE "$regex" <<<"$folders" || fail "$rules: a rule for ${regex:2:-2}, a folder that does not exist"
    for word in ${folder_allows[i]}; do
      [[ $word != */* || -e $word ]] || fail "$rules: the rule for ${regex:2:-2} allows $word, which does not exist"
    done
  done
}

check_includes
check_links
[[ -n ${1:-} && -z ${2:-} ]] || check_rules_name_folders # a tree under the rules of another has not all of its folders
check_core_names_no_plugin
if ((failures > 0)); then
  echo "$failures include rules broken (tests/include_rules/rules.txt says who may include what)"
  exit 1
fi
