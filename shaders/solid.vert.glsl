#version 330 core
// Finger and arrows. A unit vertex stores its direction and its half along x, so that one mesh gives spheres,
// ellipsoids and capsules: point = semi_axes * direction + half * half_length along x.
layout(location = 0) in vec4 direction_half;  // unit direction, -1 or 1
layout(location = 1) in vec3 unit_normal;
uniform mat4 model_view;                      // body frame -> eye, rigid
uniform mat4 projection;
uniform vec3 semi_axes;
uniform float half_length;
out vec3 normal_eye;
out vec3 from_eye;

void main() {
  vec3 body = semi_axes * direction_half.xyz + vec3(half_length * direction_half.w, 0.0, 0.0);
  vec4 eye = model_view * vec4(body, 1.0);
  normal_eye = mat3(model_view) * (unit_normal / semi_axes);
  from_eye = eye.xyz;
  gl_Position = projection * eye;
}
