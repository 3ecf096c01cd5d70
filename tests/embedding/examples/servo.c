/* A servo in C: servo MESH. A finger circles on the top of the mesh, 1 mm deep, at 1 kHz for half a second; a real one
 * would read its position from the device, and send force_n through the maker's own limits. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <tangent/tangent_c.h>
#include <time.h>

static int say(const char* what) {
  fprintf(stderr, "servo: %s\n", what);
  return 1;
}

static int run(tangent_stepper* stepper, const tangent_preset* preset, double height_m) {
  tangent_input in = TANGENT_INPUT_INIT;
  tangent_output out = TANGENT_OUTPUT_INIT;
  struct timespec next;
  double largest_n = 0.0;
  clock_gettime(CLOCK_MONOTONIC, &next);
  for (int tick = 0; tick < 500; ++tick) {
    in.t_s = 1e-3 * tick;
    in.position_m[0] = 2e-3 * cos(6.0 * in.t_s);
    in.position_m[1] = 2e-3 * sin(6.0 * in.t_s);
    in.position_m[2] = height_m;
    if (tangent_step(stepper, preset, &in, &out) != TANGENT_OK) return say(tangent_stepper_error(stepper));
    largest_n = fmax(largest_n, out.force_n[2]);
    next.tv_nsec += 1000000; /* the next millisecond */
    if (next.tv_nsec >= 1000000000) next.tv_nsec -= 1000000000, next.tv_sec += 1;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
  }
  printf("%lu ticks, %.3f mm deep, at most %.2f N\n", (unsigned long)out.tick + 1, 1e3 * out.penetration_m, largest_n);
  return 0;
}

int main(int count, char** words) {
  tangent_scene* scene = NULL;
  tangent_preset* preset = NULL;
  tangent_stepper* stepper = NULL;
  tangent_scene_info info = TANGENT_SCENE_INFO_INIT;
  double radius_m = 0.0;
  int failed = 1;
  if (tangent_load_scene(TANGENT_C_VERSION, count > 1 ? words[1] : "sphere.obj", NULL, &scene) != TANGENT_OK) {
    say(tangent_scene_error(scene));
  } else if (tangent_make_preset(TANGENT_C_VERSION, &preset) != TANGENT_OK ||
             tangent_get_value(preset, "finger.radius_m", &radius_m) != TANGENT_OK) {
    say(tangent_preset_error(preset));
  } else if (tangent_get_scene_info(scene, &info) == TANGENT_OK &&
             tangent_make_stepper(scene, &stepper) == TANGENT_OK) {
    failed = run(stepper, preset, info.box_max_m[2] + radius_m - 1e-3);
  }
  tangent_free_stepper(stepper), tangent_free_preset(preset), tangent_free_scene(scene);
  return failed;
}
