#version 330 core
// One instance per stroke: two ends, a colour, a width in pixels; equal ends make a round point. The quad is expanded
// in screen space here; ends are round.
layout(location = 0) in vec3 end_a;
layout(location = 1) in vec3 end_b;
layout(location = 2) in vec4 stroke_colour;
layout(location = 3) in float stroke_width_px;
uniform mat4 model_view;
uniform mat4 projection;
uniform vec2 view_px;
uniform float toward_eye;   // depth offset of strokes towards the eye, as a fraction of the distance
uniform float width_scale;
uniform vec4 slice;         // points with dot(slice, position) < 0 are hidden
flat out vec4 colour_in;
flat out vec2 half_width_length;
noperspective out vec2 place;  // pixels: across, along from end a

void main() {
  vec4 a = projection * vec4((model_view * vec4(end_a, 1.0)).xyz * (1.0 - toward_eye), 1.0);
  vec4 b = projection * vec4((model_view * vec4(end_b, 1.0)).xyz * (1.0 - toward_eye), 1.0);
  // Clips at the near plane, z = -w, before the division.
  float da = a.z + a.w, db = b.z + b.w;
  if (da < 0.0 && db > 0.0) a = mix(a, b, (0.0 - da) / (db - da) + 1e-5);
  if (db < 0.0 && da > 0.0) b = mix(b, a, (0.0 - db) / (da - db) + 1e-5);
  vec2 pa = 0.5 * view_px * a.xy / a.w, pb = 0.5 * view_px * b.xy / b.w;
  vec2 along = pb - pa;
  float len = length(along);
  along = len > 1e-4 ? along / len : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  float half_width = 0.5 * stroke_width_px * width_scale;
  float reach = half_width + 1.0;
  bool at_b = gl_VertexID >= 2;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  vec4 end = at_b ? b : a;
  vec2 offset = side * reach * across + (at_b ? reach : -reach) * along;
  place = vec2(side * reach, at_b ? len + reach : -reach);
  half_width_length = vec2(half_width, len);
  colour_in = stroke_colour;
  gl_Position = vec4(end.xy + 2.0 * offset / view_px * end.w, end.zw);
  gl_ClipDistance[0] = dot(slice, vec4(at_b ? end_b : end_a, 1.0));
  if (da < 0.0 && db < 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
