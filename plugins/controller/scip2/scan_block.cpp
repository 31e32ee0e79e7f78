// SPDX-License-Identifier: MIT
#include "scan_block.hpp"

#include <algorithm>

namespace muro::scip2 {

namespace {

struct Reading {
  std::uint32_t distance = 0, intensity = 0;
};

Reading reading_at(const ScanView& scan, std::uint32_t step) {
  if (step < scan.first_step || step - scan.first_step >= scan.distances.size()) return {};
  return {scan.distances[step - scan.first_step], scan.intensities[step - scan.first_step]};
}

Reading reading_of_cluster(const ScanView& scan, std::uint32_t begin, std::uint32_t last) {
  Reading least = reading_at(scan, begin);
  for (std::uint32_t step = begin + 1; step <= last; ++step) {
    const Reading r = reading_at(scan, step);
    const bool is_code = r.distance < scan.least_distance, least_is_code = least.distance < scan.least_distance;
    if (!is_code && (least_is_code || r.distance < least.distance)) least = r;
  }
  return least;
}

}  // namespace

ValueForm form_of(Command c) {
  switch (c) {
    case Command::GS:
    case Command::MS:
      return {2, false};
    case Command::GE:
    case Command::ME:
    case Command::HE:
    case Command::NE:
      return {3, true};
    default:
      return {3, false};
  }
}

void write_scan(ReplyWriter& reply, const ScanView& scan, const ScanWindow& window, ValueForm form, bool has_sums) {
  const std::uint32_t greatest = ReplyWriter::greatest(form.characters);
  reply.begin_block(has_sums);
  for (std::uint32_t step = window.start; step <= window.end; step += window.cluster) {
    const Reading r = reading_of_cluster(scan, step, std::min(step + window.cluster - 1, window.end));
    reply.value(std::min(r.distance, greatest), form.characters);
    if (form.has_intensities) reply.value(std::min(r.intensity, greatest), form.characters);
  }
  reply.end_block();
}

}  // namespace muro::scip2
