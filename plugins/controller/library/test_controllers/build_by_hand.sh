#!/bin/sh
# SPDX-License-Identifier: MIT
# build_by_hand.sh COMPILER SOURCE_TREE OUTPUT_FOLDER: builds control code as docs/guide/controllers.md says, from the page's own
# example and from examples/urban/wander.c, with all warnings as errors.
set -eu

compiler=$1 tree=$2 out=$3
# shellcheck disable=SC2016 # these are backticks of the page
sed -n '/^```c$/,/^```$/{/^```/d;p}' "$tree/docs/guide/controllers.md" >"$out/brake.c"
grep -q muro_controller_table "$out/brake.c"
for source in "$out/brake.c" "$tree/examples/urban/wander.c"; do
  name=$(basename "$source" .c)
  "$compiler" -std=c11 -O2 -Wall -Wextra -Wpedantic -Werror -ffp-contract=off -shared -fPIC -Wl,-Bsymbolic -I "$tree/sdk/c" \
    -o "$out/$name.so" "$source" -lm -lsleef
done
