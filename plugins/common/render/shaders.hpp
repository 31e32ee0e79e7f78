// SPDX-License-Identifier: MIT
// Shaders. Positions are relative to the camera, in the axes of the world, so that single precision is also enough far
// from the origin.
#pragma once

namespace muro::render::shaders {

/// Vertex shader for colours, depths and shadows.
constexpr const char* instance_vertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 row0;
layout(location = 3) in vec4 row1;
layout(location = 4) in vec4 row2;
layout(location = 5) in vec3 color;
layout(location = 6) in uint label;
layout(location = 7) in float metres;
layout(location = 8) in vec2 coordinates;
layout(location = 0) uniform mat4 to_clip;
out vec3 at;
out vec3 surface_normal;
flat out vec3 surface_color;
flat out float in_metres;
flat out uint object_label;
out vec2 texture_at;
void main() {
  vec4 p = vec4(position, 1);
  at = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  vec3 x = vec3(row0.x, row1.x, row2.x), y = vec3(row0.y, row1.y, row2.y), z = vec3(row0.z, row1.z, row2.z);
  surface_normal = x * (normal.x / dot(x, x)) + y * (normal.y / dot(y, y)) + z * (normal.z / dot(z, z));
  surface_color = color;
  in_metres = metres;
  object_label = label;
  texture_at = coordinates;
  gl_Position = to_clip * vec4(at, 1);
})";

constexpr const char* label_fragment = R"(#version 450 core
flat in uint object_label;
layout(location = 0) out uint label;
void main() { label = object_label; })";

constexpr const char* depth_fragment = R"(#version 450 core
void main() {})";

/// Text before `color_fragment`, with shadows or without. There are two programs, because a renderer without a GPU runs
/// both sides of every branch.
constexpr const char* with_shadows = "#version 450 core\n#define SHADOWS\n";
constexpr const char* without_shadows = "#version 450 core\n";

/// Lambert's law under a sun and a sky that is brighter above than the ground below. Distance fades to the horizon.
constexpr const char* color_fragment = R"(
in vec3 at;
in vec3 surface_normal;
flat in vec3 surface_color;
flat in float in_metres;
in vec2 texture_at;
layout(location = 1) uniform vec3 to_sun;
layout(location = 2) uniform mat4 to_shadow;
layout(location = 3) uniform float shadow_size;
layout(location = 4) uniform vec2 eye;
layout(location = 5) uniform vec3 horizon;
layout(binding = 0) uniform sampler2DShadow shadow_map;
layout(binding = 1) uniform sampler2D surface_texture;
layout(location = 0) out vec4 color;

#ifdef SHADOWS
float sunlit(vec3 n) {
  vec3 p = (to_shadow * vec4(at + n * 0.02, 1)).xyz;
  vec2 edge = abs(p.xy);
  if (max(edge.x, edge.y) > 1 || p.z < 0) return 1;
  float sum = 0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      sum += texture(shadow_map, vec3(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y, p.z) + vec3(i, j, 0) / shadow_size);
  float fade = smoothstep(0.85, 1.0, max(edge.x, edge.y));
  return mix(sum / 9, 1, fade);
}
#else
float sunlit(vec3 n) { return 1; }
#endif

/// 1 on light and 0 on dark tiles; between, where a pixel covers several.
float tiles(vec2 p) {
  vec2 w = max(fwidth(p), 1e-4);
  vec2 i = 2 * (abs(fract((p - 0.5 * w) / 2) - 0.5) - abs(fract((p + 0.5 * w) / 2) - 0.5)) / w;
  return 0.5 - 0.5 * i.x * i.y;
}

void main() {
  vec3 n = normalize(gl_FrontFacing ? surface_normal : -surface_normal);
  vec3 base = pow(surface_color, vec3(2.2)) * texture(surface_texture, in_metres > 0 ? at.xy + eye : texture_at).rgb;
  if (in_metres > 0 && textureSize(surface_texture, 0).x == 1) base *= mix(0.82, 1.0, tiles(at.xy + eye));
  float sun = max(dot(n, to_sun), 0);
  if (sun > 0) sun *= sunlit(n);
  vec3 sky = mix(vec3(0.20, 0.19, 0.18), vec3(0.42, 0.48, 0.56), 0.5 + 0.5 * n.z);
  vec3 lit = base * (sky + sun * vec3(0.95, 0.91, 0.84));
  color = vec4(mix(horizon, lit, exp(-dot(at, at) / (450 * 450))), 1);
})";

/// Shaders for lines and points over an image.
constexpr const char* line_vertex = R"(#version 450 core
layout(location = 0) in vec3 at;
layout(location = 1) in vec4 color;
layout(location = 0) uniform mat4 to_clip;
out vec4 surface_color;
void main() {
  surface_color = color;
  gl_Position = to_clip * vec4(at, 1);
})";

constexpr const char* line_fragment = R"(#version 450 core
in vec4 surface_color;
layout(location = 0) out vec4 color;
void main() { color = vec4(pow(surface_color.rgb, vec3(2.2)), surface_color.a); })";

/// A triangle that covers the whole image.
constexpr const char* sky_vertex = R"(#version 450 core
layout(location = 0) uniform mat4 from_clip;
out vec3 direction;
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
  direction = (from_clip * vec4(p, 0, 1)).xyz;
  gl_Position = vec4(p, 0, 1);
})";

constexpr const char* sky_fragment = R"(#version 450 core
in vec3 direction;
layout(location = 5) uniform vec3 horizon;
layout(location = 0) out vec4 color;
void main() {
  float up = normalize(direction).z;
  color = vec4(mix(horizon, vec3(0.16, 0.32, 0.62), pow(max(up, 0), 0.5)), 1);
})";

}  // namespace muro::render::shaders
