#version 330 core
// The smooth surface: points and interpolated normals from core's evaluator.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec2 patch_weights;
uniform mat4 model_view;
uniform mat4 projection;
uniform float toward_eye;  // depth offset, fraction of the distance: the surface wins where it coincides with facets
uniform vec4 slice;        // points with dot(slice, position) < 0 are hidden
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
