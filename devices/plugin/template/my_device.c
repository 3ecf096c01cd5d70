/* A force device of your own. Where it says HERE, your device comes in; until then it is a handle of 0.1 kg on the desk
 * that rolls where the force pushes it, so that all of it can be tried. tangent_device.h says what holds for each
 * function; devices/plugin/README.md how to build and load it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <stdatomic.h>

#include "tangent_device.h"

#define HALF_SIZE_M 0.08 /* of the workspace */

typedef struct {
  double time_s;
  double position_m[3], velocity_m_per_s[3];
  atomic_int stopped; /* set by stop, from another thread; cleared by the next command */
} my_device;

static char error[200] = "nothing went wrong";

/* Two of a kind are told apart by a setting: --plugin-setting serial=0042. */
static const char* setting(const tangent_device_settings* settings, const char* key, const char* otherwise) {
  for (uint32_t i = 0; i < settings->count; ++i)
    if (strcmp(settings->keys[i], key) == 0) return settings->values[i];
  return otherwise;
}

static int capabilities(const tangent_device_settings* settings, tangent_device_capabilities* can) {
  /* HERE: what your device can do. What you don't know stays 0. Forces are limited to the peak, and the workspace. */
  snprintf(can->name, sizeof can->name, "my device");
  snprintf(can->serial, sizeof can->serial, "%s", setting(settings, "serial", ""));
  can->pushes_along = 1 | 2 | 4; /* x, y, z */
  can->peak_force_n = 3.0;
  can->continuous_force_n = 1.0;
  for (int axis = 0; axis < 3; ++axis) can->workspace_half_size_m[axis] = HALF_SIZE_M;
  can->rate_hz = 1000.0;
  /* HERE: after how long without a command the device itself lets go. 0: never, and a person has to agree to that. */
  can->firmware_timeout_s = 0.05;
  return 0;
}

static int open_device(const tangent_device_settings* settings, void** device) {
  (void)settings;
  my_device* mine = calloc(1, sizeof *mine); /* all memory is allocated here, none in exchange */
  if (mine == NULL) {
    snprintf(error, sizeof error, "no memory; close other programs");
    return 1;
  }
  /* HERE: find the device and open it, without force. Where that fails: write to `error` what is wrong and what to do,
   * free `mine` and return 1. */
  *device = mine;
  return 0;
}

static int exchange(void* device, const tangent_device_command* command, tangent_device_sample* sample) {
  my_device* mine = device;
  const double mass_kg = 0.1, friction_n_s_per_m = 2.0;
  atomic_store(&mine->stopped, 0);
  mine->time_s += command->dt_s; /* HERE: when the position was measured, by a clock that never runs backwards */
  for (int axis = 0; axis < 3; ++axis) {
    /* HERE: send command->force_n to the motors (N, the device's frame), and read the position (m, its middle is 0). Do
     * not wait for either: a read that may take longer than 0.1 ms belongs in a thread of its own. */
    const double force_n = command->force_n[axis] - friction_n_s_per_m * mine->velocity_m_per_s[axis];
    mine->velocity_m_per_s[axis] += force_n / mass_kg * command->dt_s;
    mine->position_m[axis] += mine->velocity_m_per_s[axis] * command->dt_s;
    if (mine->position_m[axis] > HALF_SIZE_M) mine->position_m[axis] = HALF_SIZE_M;
    if (mine->position_m[axis] < -HALF_SIZE_M) mine->position_m[axis] = -HALF_SIZE_M;
    sample->position_m[axis] = mine->position_m[axis];
    sample->force_n[axis] = command->force_n[axis];
  }
  sample->time_s = mine->time_s;
  sample->age_s = 0.0; /* HERE: how old that position is by now */
  sample->orientation[0] = 1.0;
  /* HERE: one that needs homing is TANGENT_DEVICE_FIRMWARE until command->request is TANGENT_DEVICE_HOME. */
  sample->state = TANGENT_DEVICE_READY;
  sample->fault = TANGENT_DEVICE_NO_FAULT;
  return 0; /* HERE: 1, with `error` written, when the device no longer answers */
}

/* From any thread, also while exchange hangs, and from a crash: only switches the force off. */
static void stop(void* device) {
  my_device* mine = device;
  atomic_store(&mine->stopped, 1); /* HERE: zero force to the motors, by the shortest way */
}

static void close_device(void* device) {
  /* HERE: release the device. */
  free(device);
}

static const char* error_text(void* device) {
  (void)device;
  return error;
}

const tangent_device_plugin* tangent_device_entry(uint32_t version) {
  static const tangent_device_plugin table = {
      sizeof(tangent_device_plugin), TANGENT_DEVICE_VERSION, capabilities, open_device, exchange, stop, close_device,
      error_text};
  return version == TANGENT_DEVICE_VERSION ? &table : NULL;
}
