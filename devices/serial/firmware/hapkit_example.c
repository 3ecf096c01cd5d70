#include "hapkit_example.h"

#include <string.h>

static float metres_per_radian(const hapkit_geometry* g) { return g->handle_m * g->pulley_m / g->sector_m; }

float hapkit_position_m(const hapkit_geometry* g, int32_t counts) {
  const float angle_rad = 6.2831853f * (float)counts / g->counts_per_turn;
  return metres_per_radian(g) * angle_rad;
}

float hapkit_torque_nm(const hapkit_geometry* g, float force_n) { return force_n * metres_per_radian(g); }

float hapkit_duty(const hapkit_geometry* g, float force_n) {
  const float duty = hapkit_torque_nm(g, force_n) / g->torque_at_full_duty_nm;
  if (duty > 1.0f) return 1.0f;
  if (duty < -1.0f) return -1.0f;
  return duty == duty ? duty : 0.0f; /* no number: no torque */
}

static int measure(void* context, tangent_reading* reading) {
  hapkit* kit = (hapkit*)context;
  int32_t counts = 0;
  if (hapkit_read_counts(&counts) == 0) return 0;
  reading->position_m[0] = reading->position_m[1] = 0.0f;
  reading->position_m[2] = hapkit_position_m(&kit->geometry, counts - kit->zero_counts);
  return 1;
}

static void push(void* context, const float force_n[3]) {
  const hapkit* kit = (const hapkit*)context;
  hapkit_set_duty(hapkit_duty(&kit->geometry, force_n[2]));
}

/* By hand: whoever arms it holds the handle in the middle. */
static int home(void* context) {
  hapkit* kit = (hapkit*)context;
  return hapkit_read_counts(&kit->zero_counts) != 0 ? 1 : -1;
}

static void send(void* context, const uint8_t* bytes, size_t count) {
  (void)context;
  hapkit_send(bytes, count);
}

void hapkit_init(hapkit* kit, const hapkit_geometry* geometry, float peak_n, uint32_t serial) {
  tangent_board board;
  tangent_description is;
  float step_m;
  memset(kit, 0, sizeof *kit);
  kit->geometry = *geometry;
  board.context = kit;
  board.measure = measure;
  board.push = push;
  board.home = home;
  board.send = send;
  memset(&is, 0, sizeof is); /* what is left out is not known */
  is.firmware_version = 0x0100;
  is.serial = serial;
  is.pushes_along = 4; /* z alone */
  is.peak_mn = (uint16_t)(peak_n < 65.0f ? 1e3f * peak_n : 65000.0f);
  step_m = hapkit_position_m(geometry, 1); /* negative where the motor is mounted the other way round */
  is.step_nm = (uint32_t)(1e9f * (step_m < 0.0f ? -step_m : step_m));
  is.workspace_um[2] = 40000;
  is.telemetry_hz = 1000;
  is.watchdog_ms = 20;
  tangent_init(&kit->firmware, &board, &is);
}
