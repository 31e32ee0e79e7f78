// SPDX-License-Identifier: MIT
// Mesh files that tests write.
#pragma once

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "mesh.hpp"

namespace muro::mesh::testing {

/// Makes a box from `low` to `high` that faces outward.
inline Mesh box(const Vec3& low, const Vec3& high) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back({(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

inline std::string stl_text(const Mesh& m) {
  std::ostringstream out;
  out << "solid part\n";
  for (const Triangle& t : m.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t c : t)
      out << "vertex " << m.vertices[c].x() << ' ' << m.vertices[c].y() << ' ' << m.vertices[c].z() << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid part\n";
  return out.str();
}

/// Makes a binary STL file. `header`: the first of its 80 bytes without a meaning.
inline std::string stl_binary(const Mesh& m, const std::string& header = "binary") {
  std::string out = header;
  out.resize(80, ' ');
  const auto add = [&](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
  };
  add(std::uint32_t(m.triangles.size()));
  for (const Triangle& t : m.triangles) {
    for (int i = 0; i < 3; ++i) add(0.0F);
    for (const std::uint32_t c : t)
      for (int k = 0; k < 3; ++k) add(float(m.vertices[c][k]));
    add(std::uint16_t(0));
  }
  return out;
}

inline std::string obj_text(const Mesh& m) {
  std::ostringstream out;
  for (const Vec3& v : m.vertices) out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const Triangle& t : m.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.str();
}

/// Makes a COLLADA 1.4 file: one geometry, instanced by nodes with the transforms given (elements of <node>).
inline std::string dae_text(const Mesh& m, const std::string& up_axis, const std::string& metres,
                            const std::vector<std::string>& transforms = {""}) {
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
      << "<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified><unit name=\"unit\" "
         "meter=\""
      << metres << "\"/><up_axis>" << up_axis << "</up_axis></asset>\n<library_geometries><geometry id=\"g\"><mesh>"
      << "<source id=\"p\"><float_array id=\"pa\" count=\"" << 3 * m.vertices.size() << "\">";
  for (const Vec3& v : m.vertices) out << v.x() << ' ' << v.y() << ' ' << v.z() << ' ';
  out << "</float_array><technique_common><accessor source=\"#pa\" count=\"" << m.vertices.size()
      << "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
         "type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
         "source=\"#p\"/></vertices><triangles count=\""
      << m.triangles.size() << "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>";
  for (const Triangle& t : m.triangles) out << t[0] << ' ' << t[1] << ' ' << t[2] << ' ';
  out << "</p></triangles></mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene id=\"s\">";
  for (std::size_t i = 0; i < transforms.size(); ++i)
    out << "<node id=\"n" << i << "\">" << transforms[i] << "<instance_geometry url=\"#g\"/></node>";
  out << "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene>\n</COLLADA>\n";
  return out.str();
}

/// Makes a glTF 2.0 file with its buffer inside.
inline std::string gltf_text(const Mesh& m) {
  std::string bytes;
  for (const Vec3& v : m.vertices)
    for (int k = 0; k < 3; ++k) {
      const auto x = float(v[k]);
      bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
    }
  const std::size_t positions = bytes.size();
  for (const Triangle& t : m.triangles)
    for (const std::uint32_t c : t) bytes.append(reinterpret_cast<const char*>(&c), sizeof c);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) base64 += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  const Aabb box = bounds_of(m);
  std::ostringstream out;
  out << "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
      << "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"buffers\":[{\"byteLength\":"
      << bytes.size() << ",\"uri\":\"data:application/octet-stream;base64," << base64
      << "\"}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":" << positions
      << "},{\"buffer\":0,\"byteOffset\":" << positions << ",\"byteLength\":" << bytes.size() - positions
      << "}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":" << m.vertices.size()
      << ",\"type\":\"VEC3\",\"min\":[" << box.low.x() << ',' << box.low.y() << ',' << box.low.z() << "],\"max\":["
      << box.high.x() << ',' << box.high.y() << ',' << box.high.z()
      << "]},{\"bufferView\":1,\"componentType\":5125,\"count\":" << 3 * m.triangles.size()
      << ",\"type\":\"SCALAR\"}]}";
  return out.str();
}

}  // namespace muro::mesh::testing
