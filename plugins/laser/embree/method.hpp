// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "plugins/common/scanner/method.hpp"
#include "solids.hpp"

namespace muro::embree {

/// Distances by Embree's search: exact to shapes with a closed form, in single precision to the triangles of meshes.
class Embree final : public scanner::Method {
 public:
  Embree();
  ~Embree() override;

  void connect(Connector& c) override;
  void prepare(std::span<const scanner::RaySet> sets) override;
  void start() override;
  void look() override;
  void cast(std::size_t set, const scanner::View& view, std::span<double> ranges, std::span<ObjectId> hits) override;
  bool is_parallel() const override { return true; }
  bool is_cheap_for_few() const override { return true; }

 private:
  /// A mesh on a body.
  struct Placed {
    Solid solid;
    RTCGeometry instance = nullptr;
  };

  void add_body(Connector& c, ObjectId object, const Solid& of_body);
  RTCScene mesh(const std::string& path, const Vec3& scale);
  void place(const Placed& p) const;
  static void skip_ignored(const RTCFilterFunctionNArguments* a);

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::map<std::tuple<std::string, double, double, double>, RTCScene> meshes_;  ///< by file and scale
  std::vector<Solid> fixed_, moving_, planes_;
  std::vector<Placed> placed_;
  SolidGeometry scenery_, robots_;
  std::vector<std::int32_t> robot_of_;  ///< by geometry of the scene
  std::vector<ObjectId> object_of_;     ///< likewise
  std::vector<scanner::RaySet> sets_;
  bool built_ = false;
};

}  // namespace muro::embree
