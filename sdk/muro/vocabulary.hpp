// SPDX-License-Identifier: MIT
// The standard names, by what has them. Terms follow URDF, SDF and ROS; units are SI; frames follow REP-103.
#pragma once

#include "muro/vocabulary/body.hpp"
#include "muro/vocabulary/camera.hpp"
#include "muro/vocabulary/contact.hpp"
#include "muro/vocabulary/joint.hpp"
#include "muro/vocabulary/laser.hpp"
#include "muro/vocabulary/model.hpp"
#include "muro/vocabulary/radio.hpp"
#include "muro/vocabulary/sensor.hpp"
