// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "model.hpp"
#include "muro/parameter.hpp"

namespace muro::scip2 {

inline constexpr std::string_view model_choices[] = {"urg-04lx", "utm-30lx", "ust-10lx"};
inline constexpr std::string_view start_choices[] = {"model", "either", "scip1.1", "scip2.0"};
inline constexpr std::string_view session_choices[] = {"power_cycle", "keep"};

/// Parameters that describe the device.
inline constexpr std::array device_parameters = {
    text("model", "urg-04lx", "the device; what follows replaces single entries of it").one_of(model_choices),
    integer("dmin", 20, "mm, DMIN: least distance; not given, as all of these: the model's").between(1, 262143),
    integer("dmax", 5600, "mm, DMAX: greatest distance").between(1, 262143),
    integer("ares", 1024, "ARES: steps in a turn").between(4, 100000),
    integer("amin", 44, "AMIN: first step that measures").between(0, 9999),
    integer("amax", 725, "AMAX: last step that measures").between(0, 9999),
    integer("afrt", 384, "AFRT: step that looks to the front").between(0, 9999),
    integer("scan", 600, "rpm, SCAN: turns of the mirror in a minute").between(1, 60000),
    text("modl", "", "MODL of PP; empty: the model's"),
    text("product", "", "PROD of VV; empty: the model's"),
    text("firmware", "", "FIRM of VV; empty: the model's. A urg-04lx knows HS and DB from 3.3.00 on"),
    text("serial", "", "SERI of VV; empty: the model's"),
    text("start", "model", "what is spoken until `SCIP2.0`; model: either by a urg-04lx, scip2.0 by the others")
        .one_of(start_choices),
    real("reply_grid", "s", 0.1,
         "requests are answered at multiples of this; 0: at once; not given: by a urg-04lx with each scan, by the "
         "others "
         "at once")
        .between(0, 10),
    boolean("intensity", true, "knows ME and GE"),
    boolean("multiecho", false, "knows ND, NE, HD and HE, with one echo each"),
};

/// Throws muro::Error when entries contradict each other or cannot be sent.
Model read_model(const Parameters& p);

}  // namespace muro::scip2
