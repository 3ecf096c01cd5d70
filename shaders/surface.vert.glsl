#version 330 core
// The smooth surface: points and interpolated normals from core's evaluator.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec2 patch_weights;
uniform mat4 model_view;
uniform mat4 projection;
uniform float toward_eye;  // share of the distance: where surface and facets coincide, the surface shows
uniform vec4 slice;        // what has dot(slice, position) < 0 is cut away
out vec3 normal_eye;
out vec3 from_eye;
out vec2 weights;

void main() {
  vec4 eye = model_view * vec4(position, 1.0);
  normal_eye = mat3(model_view) * normal.xyz;
  from_eye = eye.xyz;
  gl_ClipDistance[0] = dot(slice, vec4(position, 1.0));
  weights = patch_weights;
  gl_Position = projection * vec4(eye.xyz * (1.0 - toward_eye), 1.0);
}
