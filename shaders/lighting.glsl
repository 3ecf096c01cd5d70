// Soft studio light, fixed to the eye so that the object is lit from every view: a warm key light from the upper left,
// a cool fill light from the right, and a hemisphere light about the world's up. All colours are sRGB values; the light
// was tuned by eye in that space.
uniform vec3 up_eye;  // unit, world up in eye space

vec3 lit(vec3 albedo, vec3 n) {
  const vec3 key_direction = vec3(-0.442, 0.602, 0.665);
  const vec3 fill_direction = vec3(0.766, 0.051, 0.641);
  float sky = 0.5 + 0.5 * dot(n, up_eye);
  float key = max(dot(n, key_direction), 0.0);
  float fill = max(dot(n, fill_direction), 0.0);
  vec3 light = mix(vec3(0.335, 0.345, 0.355), vec3(0.55, 0.57, 0.59), sky);
  light += key * vec3(0.485, 0.48, 0.455) + fill * vec3(0.09, 0.11, 0.13);
  return albedo * light;
}

// Highlight of the key light for a unit normal and unit direction to the eye.
float highlight(vec3 n, vec3 to_eye, float tightness) {
  vec3 halfway = normalize(vec3(-0.442, 0.602, 0.665) + to_eye);
  float x = max(dot(n, halfway), 0.0);
  return exp2(tightness * (x - 1.0));
}
