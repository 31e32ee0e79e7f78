// SPDX-License-Identifier: MIT
#pragma once

#include <urdf_model/model.h>

#include <memory>
#include <string>

#include "document.hpp"

namespace muro::urdf {

/// Returns the model that urdfdom reads from `xml`, or null. Messages that urdfdom would print go to `problems`. The
/// text must have passed the checks of model.hpp: urdfdom overflows the stack on deeply nested elements, uses names as
/// format strings in some of its messages, leaks memory on loops of links, and skips unknown elements.
std::shared_ptr<const ::urdf::ModelInterface> parse_with_urdfdom(const std::string& xml, Problems& problems);

}  // namespace muro::urdf
