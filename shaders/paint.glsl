// Map colours and isolation for facets and surface. Patches are in the order of the usable triangles; parts of a patch
// as in core/lab/measure/surface_map.h.
uniform int map_level;              // parts along a patch's edge; 0: no map
uniform samplerBuffer map_values;   // level^2 a patch
uniform sampler2D map_colours;      // one row
uniform vec2 map_range;             // of the value, or of its logarithm
uniform int map_log;
uniform vec3 map_pending_colour;
uniform vec3 map_none_colour;
uniform int isolate;                // 1: only patches whose mask is set
uniform usamplerBuffer kept;
uniform int patch_triangles;        // triangles drawn for each patch; 0: looked up in `sources`
uniform int first_triangle;         // of this draw call
uniform usamplerBuffer sources;

int patch_of(int primitive) {
  int triangle = first_triangle + primitive;
  return patch_triangles > 0 ? triangle / patch_triangles : int(texelFetch(sources, triangle).r);
}

bool left_out(int patch_index) { return isolate != 0 && texelFetch(kept, patch_index).r == 0u; }

int part_of(vec2 weights) {
  vec2 at = clamp(weights, 0.0, 1.0) * float(map_level);
  int row = min(int(at.y), map_level - 1);
  int column = min(int(at.x), map_level - 1 - row);
  bool upper = (at.x - float(column)) + (at.y - float(row)) > 1.0 && row + column + 1 < map_level;
  return row * (2 * map_level - row) + 2 * column + (upper ? 1 : 0);
}

vec3 map_colour(int patch_index, vec2 weights) {
  float value = texelFetch(map_values, patch_index * map_level * map_level + part_of(weights)).r;
  if (value < -2.5e38) return map_pending_colour;
  if (value < -1.0e38) return map_none_colour;
  float x = map_log != 0 ? log(max(value, 1e-30)) : value;
  float t = clamp((x - map_range.x) / (map_range.y - map_range.x), 0.0, 1.0);
  return texture(map_colours, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}

// Keeps a map's colours readable: lighting only hints at the shape.
vec3 lit_map(vec3 colour, vec3 light) { return colour * mix(vec3(1.0), light, 0.42); }
