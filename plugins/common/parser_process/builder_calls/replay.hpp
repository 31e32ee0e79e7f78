// SPDX-License-Identifier: MIT
#pragma once

#include "muro/model_reader.hpp"
#include "plugins/common/parser_process/message.hpp"

namespace muro::builder_calls {

/// Makes the calls that a recorder has written. Throws muro::Error when the message is garbled.
void replay(parser_process::Reader calls, RobotBuilder& builder);
void replay(parser_process::Reader calls, WorldBuilder& builder);

}  // namespace muro::builder_calls
