#version 330 core
uniform float opacity;
in vec4 colour_in;
out vec4 colour;

void main() { colour = vec4(colour_in.rgb, colour_in.a * opacity); }
