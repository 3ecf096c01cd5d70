// Coverage of a triangle's edges, from barycentric weights: a line about `width_px` wide that fades as the triangle
// shrinks, so that a dense mesh is tinted, not black. The weights are those of the triangle's corners 1 and 2.
float edge_coverage(vec2 weights, float width_px) {
  vec3 w = vec3(1.0 - weights.x - weights.y, weights);
  vec3 per_pixel = fwidth(w);
  vec3 pixels = w / max(per_pixel, vec3(1e-9));
  float nearest = min(min(pixels.x, pixels.y), pixels.z);
  float height_px = 1.0 / max(max(max(per_pixel.x, per_pixel.y), per_pixel.z), 1e-6);
  float room = smoothstep(1.5, 22.0, height_px);
  return (1.0 - smoothstep(0.5 * width_px - 0.5, 0.5 * width_px + 0.5, nearest)) * mix(0.10, 1.0, room);
}
