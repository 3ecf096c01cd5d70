#version 330 core
// Flat facets, three own vertices each, so that a facet is lit once and its edges come from barycentric weights,
// without a second pass and without depth fighting.
#include "lighting.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 face_normal;
uniform mat4 model_view;
uniform mat4 projection;
uniform vec3 albedo;
uniform vec3 inside_albedo;
uniform vec4 slice;       // points with dot(slice, position) < 0 are hidden
flat out vec3 facet_colour;
flat out vec3 facet_light;
out vec2 weights;

void main() {
  vec4 eye = model_view * vec4(position, 1.0);
  vec3 n = normalize(mat3(model_view) * face_normal.xyz);
  bool inside = dot(n, eye.xyz) > 0.0;
  facet_colour = lit(inside ? inside_albedo : albedo, inside ? -n : n);
  facet_light = lit(vec3(1.0), inside ? -n : n);
  gl_ClipDistance[0] = dot(slice, vec4(position, 1.0));
  int corner = gl_VertexID % 3;
  weights = vec2(corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0);
  gl_Position = projection * eye;
}
