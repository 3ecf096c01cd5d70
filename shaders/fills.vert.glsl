#version 330 core
// Translucent triangles of one colour each: planes, highlighted facets and patches.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 fill_colour;
uniform mat4 model_view;
uniform mat4 projection;
uniform float toward_eye;
out vec4 colour_in;

void main() {
  colour_in = fill_colour;
  gl_Position = projection * vec4((model_view * vec4(position, 1.0)).xyz * (1.0 - toward_eye), 1.0);
}
