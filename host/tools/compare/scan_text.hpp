// SPDX-License-Identifier: MIT
// Functions that readers of recorded scans share.
#pragma once

#include "host/tools/compare/scan_record.hpp"
#include "host/tools/identify/record_text.hpp"

namespace muro::host {

ScanRecord parse_scip_record(const std::string& text, const std::string& name);
ScanRecord parse_csv_scans(const std::string& text, const std::string& name);

}  // namespace muro::host
