/** \file
 * A force device of your own, as a shared library that the workbench loads by its path:
 *
 *   workbench monitor --force plugin --plugin ./my_device.so --plugin-setting port=/dev/ttyACM0
 *
 * The library exports one function, tangent_device_entry, which gives a table of functions. Plain C; needs nothing but
 * this header. devices/plugin/template is one of about 100 lines.
 *
 * Units and frames: SI. Position, velocity, force and orientation are in the device's own frame, right-handed, origin
 * in the middle of its workspace; `frame_...` of the capabilities says how that frame stands in the room (x away from
 * the person, along the finger; z up). Nobody else converts. The finger's own frame: x along the finger to its tip, -z
 * out of the fingerpad.
 *
 * Threads: all functions are called from one thread, one at a time, but for `stop`, which comes from any thread, also
 * while `exchange` does not return.
 *
 * Where it runs: in a process of its own, which is ended with the program and started again when it dies. A crash is a
 * fault of the device, not of the program. On request (--plugin-in-process) it runs within the program; then its crash
 * is the program's.
 *
 * Errors: a function that returns int returns 0 where it did what it should. Otherwise error_text says what is wrong
 * and what to do about it, for people. Written in C++, no exception leaves a function.
 *
 * Structs begin with their size, set by who fills them. A later version adds fields at their ends.
 */
#ifndef TANGENT_DEVICE_H
#define TANGENT_DEVICE_H

/* NOLINTBEGIN(readability-identifier-naming, modernize-deprecated-headers): C's */
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Of this interface; a plug-in of another one is refused. */
#define TANGENT_DEVICE_VERSION 1u

/** As the device reports itself. It renders force when ready, and in no other state. */
enum {
  TANGENT_DEVICE_ABSENT = 0,   /**< not attached; the plug-in looks for it while it is exchanged with */
  TANGENT_DEVICE_OPEN = 1,     /**< attached, not yet identified */
  TANGENT_DEVICE_FIRMWARE = 2, /**< identified, waits for TANGENT_DEVICE_HOME */
  TANGENT_DEVICE_HOMING = 3,   /**< finds its zero */
  TANGENT_DEVICE_READY = 4,    /**< measures and renders */
  TANGENT_DEVICE_FAULTED = 5   /**< stopped itself, until TANGENT_DEVICE_CLEAR_FAULT */
};

/** Why it is faulted. */
enum {
  TANGENT_DEVICE_NO_FAULT = 0,
  TANGENT_DEVICE_DISCONNECTED = 1,
  TANGENT_DEVICE_SENSOR = 2,
  TANGENT_DEVICE_ACTUATOR = 3,
  TANGENT_DEVICE_BAD_COMMAND = 4,
  TANGENT_DEVICE_WRONG_FIRMWARE = 5,
  TANGENT_DEVICE_WATCHDOG = 6 /**< the device heard no command in time */
};

/** What comes with a tick's command. */
enum {
  TANGENT_DEVICE_NO_REQUEST = 0,
  TANGENT_DEVICE_HOME = 1,       /**< firmware, ready -> homing */
  TANGENT_DEVICE_STOP = 2,       /**< no force; homing, ready -> open or firmware, or as it was where it needs none */
  TANGENT_DEVICE_CLEAR_FAULT = 3 /**< faulted -> open, firmware or ready */
};

/** What a person said: --plugin-setting key=value. */
typedef struct tangent_device_settings {
  uint32_t size;
  uint32_t count;
  const char* const* keys;
  const char* const* values;
} tangent_device_settings;

/** What the device can do. 0: not known or not there. */
typedef struct tangent_device_capabilities {
  uint32_t size;
  uint32_t pushes_along;     /**< bit per axis of its frame: x 1, y 2, z 4 */
  uint32_t senses_rotation;  /**< bit per rotation of the finger: roll 1, tilt 2, turn to the side 4 */
  uint32_t buttons;          /**< 32 at most; the first is the clutch */
  char name[64];             /**< for people; ends with 0 */
  char serial[64];           /**< ends with 0; empty: not known */
  double peak_force_n;       /**< never exceeded; 0: no force is sent at all */
  double continuous_force_n; /**< can be held for ever */
  double position_resolution_m;
  double apparent_mass_kg;
  double largest_stiffness_n_per_m; /**< that it renders stably */
  double largest_damping_n_s_per_m;
  double workspace_half_size_m[3]; /**< box around its origin */
  double frame_rotation[4];        /**< unit, w x y z: device frame -> room */
  double frame_origin_m[3];        /**< of the device, in the room */
  double rate_hz;                  /**< exchanges per second it is made for */
  double homing_s;                 /**< homing takes no longer; 0: it is homed by hand, or not at all */
  double firmware_timeout_s;       /**< its own watchdog: without a command it stops its force; 0: none */
} tangent_device_capabilities;

typedef struct tangent_device_command {
  uint32_t size;
  uint32_t request;  /**< TANGENT_DEVICE_HOME ... */
  uint64_t tick;     /**< of the servo */
  double dt_s;       /**< since the last exchange, > 0 */
  double force_n[3]; /**< to render from now on; finite, within the peak; zero unless the device is ready */
} tangent_device_command;

/** All of it has to be filled in. */
typedef struct tangent_device_sample {
  uint32_t size;
  uint32_t state; /**< TANGENT_DEVICE_READY ... */
  uint32_t fault; /**< TANGENT_DEVICE_SENSOR ...; of a device that is faulted */
  uint32_t buttons;
  double time_s; /**< when position and orientation were measured, by a clock of the plug-in's own that never runs
                      backwards; the same as last time: nothing new was measured */
  double age_s;  /**< since then, >= 0 */
  double position_m[3];       /**< of the finger's centre */
  double orientation[4];      /**< unit, w x y z: finger frame -> device frame */
  double velocity_m_per_s[3]; /**< where has_velocity says so */
  uint32_t has_velocity;      /**< not 0: the device measures velocity itself */
  uint32_t reserved;
  double force_n[3]; /**< rendered now */
} tangent_device_sample;

typedef struct tangent_device_plugin {
  uint32_t size;
  uint32_t version; /**< TANGENT_DEVICE_VERSION that it was compiled with */

  /** What the device can do, without opening it; the same at every call with the same settings. */
  int (*capabilities)(const tangent_device_settings* settings, tangent_device_capabilities* out);

  /** Finds and opens the device, without force; may take seconds. `*device` is a handle of the plug-in's own, given to
   * the functions below. On failure close is not called. */
  int (*open)(const tangent_device_settings* settings, void** device);

  /** One tick, 1,000 times a second: command in, sample out. Returns within the tick: it waits for nothing, and from
   * its second call on allocates no memory. Not 0: the device is lost, and stopped; a person has to clear that. */
  int (*exchange)(void* device, const tangent_device_command* command, tangent_device_sample* sample);

  /** Any thread, also while exchange does not return, and, as the last attempt, from the signal handler of a crash: no
   * force from now on, until exchange brings one again. Called before close, when the program dies or falls silent, and
   * when exchange hangs. Does not wait. May be called several times. */
  void (*stop)(void* device);

  /** Releases the device. */
  void (*close)(void* device);

  /** What went wrong last, where and what to do about it; never null. `device` is null after capabilities and open. */
  const char* (*error_text)(void* device);
} tangent_device_plugin;

/** Null: it can't work with a workbench of that version. */
typedef const tangent_device_plugin* (*tangent_device_entry_function)(uint32_t version);

#if defined(_WIN32)
#define TANGENT_DEVICE_EXPORT __declspec(dllexport)
#else
#define TANGENT_DEVICE_EXPORT __attribute__((visibility("default")))
#endif

/** The one function that a plug-in exports. */
TANGENT_DEVICE_EXPORT const tangent_device_plugin* tangent_device_entry(uint32_t version);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming, modernize-deprecated-headers) */

#endif
