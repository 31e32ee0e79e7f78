#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_test.sh: breaks each rule in a scratch tree and compares what check.sh says of it.
set -euo pipefail

check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
cd "$tree"
failures=0

# A tree without fault: every kind of arrow that is allowed.
fresh_tree() {
  find "$tree" -mindepth 1 -delete
  mkdir -p sdk/muro sdk/c core host plugins/motion/{point,bullet,common/watch} plugins/drive/servo plugins/common/render tests/core
  touch plugins/motion/common/watch/watch.hpp
  touch sdk/muro/key.hpp sdk/c/muro_controller.h core/world.hpp plugins/motion/point/kernel.hpp plugins/common/render/gl.hpp
  echo '#include "core/world.hpp" // a comment; with <brackets> and "quotes"' >host/run.cpp
  printf '%s\n' '#include "muro/key.hpp"' '#include "kernel.hpp"' '#include "plugins/motion/common/watch/watch.hpp"' \
    '#include <Eigen/Core>' '#include <span>' \
    'constexpr D d{.id = "motion.point"};' >plugins/motion/point/point.cpp
  printf '#include "core/world.hpp"\n#include <gtest/gtest.h>\n' >plugins/motion/point/point_test.cpp
  printf '#include "plugins/common/render/gl.hpp"\n#  include <btBulletDynamicsCommon.h>\n' >plugins/motion/bullet/world.cpp
  printf '#include "world.hpp"\n#include <boost/dll.hpp>\nint x; // "motion.point" is one\n' >core/load.cpp
  printf 'muro_add_plugin(NAME motion_point SOURCES point.cpp)\nmuro_add_test(NAME point_test LIBRARIES\n muro_core)\n' \
    >plugins/motion/point/CMakeLists.txt
  echo 'add_library(muro_core STATIC load.cpp)' >core/CMakeLists.txt
}

# expect TEXT: the check of the tree says TEXT, and fails unless TEXT is empty.
expect() {
  local said code=0
  said=$("$check" "$tree" 2>&1) || code=$?
  [[ -z $1 ]] || set -- "$1"$'\n'"${2:-1} include rules broken (tests/include_rules/rules.txt says who may include what)"
  if [[ $said != "$1" || $code != $([[ -z $1 ]] && echo 0 || echo 1) ]]; then
    printf 'exit code %s; expected:\n%s\nsaid:\n%s\n\n' "$code" "$1" "$said"
    failures=$((failures + 1))
  fi
  fresh_tree
}

fresh_tree
expect ''

echo '#include "core/world.hpp"' >plugins/motion/point/kernel.hpp
expect 'plugins/motion/point/kernel.hpp:1: includes "core/world.hpp" (core/world.hpp); this file may include: std plugins/motion/point sdk/muro eigen posix plugins/common plugins/motion/common'

echo '#include "../../../core/world.hpp"' >plugins/motion/bullet/world.cpp
expect 'plugins/motion/bullet/world.cpp:1: includes "../../../core/world.hpp" (core/world.hpp); this file may include: std plugins/motion/bullet sdk/muro eigen posix plugins/common plugins/motion/common bullet'

printf '\n#include "plugins/motion/point/kernel.hpp"\n' >plugins/motion/bullet/world.cpp
expect 'plugins/motion/bullet/world.cpp:2: includes "plugins/motion/point/kernel.hpp" (plugins/motion/point/kernel.hpp); this file may include: std plugins/motion/bullet sdk/muro eigen posix plugins/common plugins/motion/common bullet'

echo '#include "plugins/motion/common/watch/watch.hpp"' >plugins/drive/servo/servo.cpp
expect 'plugins/drive/servo/servo.cpp:1: includes "plugins/motion/common/watch/watch.hpp" (plugins/motion/common/watch/watch.hpp); this file may include: std plugins/drive/servo sdk/muro eigen posix plugins/common'

echo '#include "plugins/motion/common/watch/watch.hpp"' >plugins/common/render/gl.hpp
expect 'plugins/common/render/gl.hpp:1: includes "plugins/motion/common/watch/watch.hpp" (plugins/motion/common/watch/watch.hpp); this file may include: std plugins/common/render sdk/muro eigen posix plugins/common gl'

echo '#include <btBulletDynamicsCommon.h>' >plugins/motion/point/kernel.hpp
expect 'plugins/motion/point/kernel.hpp:1: includes "btBulletDynamicsCommon.h" (bullet); this file may include: std plugins/motion/point sdk/muro eigen posix plugins/common plugins/motion/common'

echo '#include "core/world.hpp"' >sdk/muro/key.hpp
expect 'sdk/muro/key.hpp:1: includes "core/world.hpp" (core/world.hpp); this file may include: std sdk/muro eigen'

echo '#include <boost/any.hpp>' >sdk/muro/key.hpp
expect 'sdk/muro/key.hpp:1: includes "boost/any.hpp" (boost); this file may include: std sdk/muro eigen'

touch host/run.hpp && echo '#include "host/run.hpp"' >core/world.hpp
expect 'core/world.hpp:1: includes "host/run.hpp" (host/run.hpp); this file may include: std core sdk/muro sdk/describe eigen boost posix json fmt'

echo '#include "plugins/motion/point/kernel.hpp"' >host/run.cpp
expect 'host/run.cpp:1: includes "plugins/motion/point/kernel.hpp" (plugins/motion/point/kernel.hpp); this file may include: std host core sdk eigen boost posix json yaml cli fmt png md'

echo '#include <nowhere/to.hpp>' >host/run.cpp
expect 'host/run.cpp:1: includes "nowhere/to.hpp", of no library that tests/include_rules/rules.txt knows; add it there'

printf 'int a;\nauto s = find("motion.point");\n' >core/load.cpp
expect 'core/load.cpp:2: names the plugin "motion.point"; core knows no plugin by name'

echo 'auto s = find("motion_point");' >core/load.cpp
expect 'core/load.cpp:1: names the plugin "motion_point"; core knows no plugin by name'

echo 'muro_add_plugin(NAME motion_point SOURCES point.cpp LIBRARIES muro_core)' >plugins/motion/point/CMakeLists.txt
expect 'plugins/motion/point/CMakeLists.txt: names muro_core; under plugins/ only muro_add_test and muro_add_bench may link it'

echo 'target_link_libraries(muro_core PRIVATE muro_host)' >core/CMakeLists.txt
expect 'core/CMakeLists.txt: names muro_host; under core/ only muro_add_test and muro_add_bench may link it'

echo '#include <ode/ode.h>' >core/world.hpp && echo '#include <unistd.h>' >sdk/muro/key.hpp
expect 'core/world.hpp:1: includes "ode/ode.h" (ode); this file may include: std core sdk/muro sdk/describe eigen boost posix json fmt
sdk/muro/key.hpp:1: includes "unistd.h" (posix); this file may include: std sdk/muro eigen' 2

printf 'folder sdk/muro own\nfolder plugins/walking own sdk/gait\n' >rules.txt
said=$("$check" "$tree" rules.txt | grep 'does not exist' || true)
wanted="$tree/rules.txt: a rule for plugins/walking, a folder that does not exist
$tree/rules.txt: the rule for plugins/walking allows sdk/gait, which does not exist"
if [[ $said != "$wanted" ]]; then
  printf 'expected:\n%s\nsaid:\n%s\n\n' "$wanted" "$said"
  failures=$((failures + 1))
fi

((failures == 0))
