// SPDX-License-Identifier: MIT
#include "store.hpp"

#include "muro/algorithm.hpp"

namespace muro::mesh {

Store::Entry& Store::entry(const std::string& path, const Vec3& scale) {
  std::unique_ptr<Entry>& e = entries_[{path, scale.x(), scale.y(), scale.z()}];
  if (!e) {
    auto new_entry = std::make_unique<Entry>();
    try {
      new_entry->mesh = load(path, scale);
    } catch (const Error& error) {
      new_entry->error = error.what();
    }
    e = std::move(new_entry);
  }
  if (!e->error.empty()) throw Error(e->error);
  return *e;
}

const Mesh& Store::mesh(const std::string& path, const Vec3& scale) { return entry(path, scale).mesh; }

const Hull& Store::hull(const std::string& path, const Vec3& scale) {
  Entry& e = entry(path, scale);
  if (!e.hull) try {
      e.hull = convex_hull(e.mesh.vertices);
    } catch (const Error& error) {
      throw Error("mesh " + path + ": " + error.what() + "; collide with it as it is (meshes: exact)");
    }
  return *e.hull;
}

const Hull& Store::hull_or_plate(const std::string& path, const Vec3& scale) {
  Entry& e = entry(path, scale);
  if (e.hull) return *e.hull;
  if (!e.plate) try {
      e.plate = mesh::hull_or_plate(e.mesh.vertices);
    } catch (const Error& error) {
      throw Error("mesh " + path + ": " + error.what());
    }
  return *e.plate;
}

}  // namespace muro::mesh
