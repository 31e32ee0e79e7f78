// SPDX-License-Identifier: MIT
#include "tests/bench/peers/city.hpp"

#include <algorithm>
#include <cmath>

#include "muro/random.hpp"

namespace muro::bench {
