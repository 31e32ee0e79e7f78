// SPDX-License-Identifier: MIT
#include "method.hpp"

namespace muro::jsonrpc {

namespace {

using Names = std::string_view[];

constexpr Names of_authenticate = {"token"}, of_list = {"pattern"}, of_describe = {"property"},
                of_get = {"properties", "element", "encoding"},
                of_subscribe = {"properties", "rate", "on_change", "least_period", "encoding"},
                of_unsubscribe = {"subscription"}, of_set = {"property", "value", "element", "unit", "values"},
                of_place = {"object", "position", "orientation_wxyz", "orientation_xyzw", "x",    "y",
                            "z",      "yaw",      "linear",           "angular",          "force"},
                of_names = {"name"}, of_speed = {"factor"}, of_step = {"seconds", "steps", "keep"}, of_pause = {"keep"},
                of_wait = {"seconds"};

constexpr Method all[] = {
    {"authenticate", of_authenticate, false, authenticate},
    {"info", {}, false, info},
    {"list", of_list, false, list},
    {"describe", of_describe, false, describe},
    {"get", of_get, false, get},
    {"time", {}, false, tell_time},
    {"hash", {}, false, hash},
    {"wait", of_wait, false, wait},
    {"subscribe", of_subscribe, false, subscribe},
    {"unsubscribe", of_unsubscribe, false, unsubscribe},
    {"set", of_set, false, set},  // each property is granted separately
    {"place", of_place, true, place},
    {"pause", of_pause, true, pause},
    {"resume", {}, true, resume},
    {"step", of_step, true, step},
    {"speed", of_speed, true, speed},
    {"stop", {}, true, stop},
    {"reset", {}, true, reset},
    {"snapshot", of_names, true, snapshot},
    {"restore", of_names, true, restore},
};

}  // namespace

std::span<const Method> methods() { return all; }

Encoding encoding_of(const Params& params) {
  const std::string name = params.text("encoding", "text");
  if (name != "text" && name != "base64")
    throw RpcError{Code::invalid_params, "`encoding` must be \"text\" or \"base64\""};
  return name == "text" ? Encoding::text : Encoding::base64;
}

Reply time_reply(std::int64_t time) { return {{"time", time}, {"seconds", double(time) / 1e9}}; }

}  // namespace muro::jsonrpc
