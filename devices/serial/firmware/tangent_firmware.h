/* A force device's side of the line: the force messages of devices/cld_protocol.md, for a microcontroller.
 *
 * Portable C99 without malloc, libm or an operating system: <stdint.h>, <stddef.h> and memcpy. It knows neither the
 * encoder nor the motor: you give it four functions. Call tangent_receive with whatever bytes came, and tangent_step as
 * often as you can, at least once a millisecond. SI units; x away from the person, y to the left, z up; the origin in
 * the middle of the workspace; 0 along axes that the device lacks.
 *
 * The force is zero unless homed; when no command came for watchdog_ms; when measure fails or gives what is no number.
 * If tangent_step itself is no longer called, nothing here helps: use the microcontroller's own watchdog, too. */
#ifndef TANGENT_FIRMWARE_H
#define TANGENT_FIRMWARE_H

#include <stddef.h> /* NOLINT(modernize-deprecated-headers): C */
#include <stdint.h> /* NOLINT(modernize-deprecated-headers): C */

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  float position_m[3];
  float orientation[4]; /* w, x, y, z, unit: finger to device; not read unless senses_rotation says so */
  uint32_t buttons;     /* bit per button, the first is 1: it is the clutch */
} tangent_reading;

typedef struct {
  void* context;                                           /* handed to each of these */
  int (*measure)(void* context, tangent_reading* reading); /* 0: the sensor failed */
  void (*push)(void* context, const float force_n[3]);     /* on the finger; 0 0 0: motors off */
  int (*home)(void* context); /* at every step while homing: 1 done, 0 goes on, -1 failed */
  void (*send)(void* context, const uint8_t* bytes, size_t count); /* all of them, or none */
} tangent_board;

/* What the device says about itself. 0: not known. Say less rather than more: the host's limits are made of it. */
typedef struct {
  uint16_t firmware_version; /* major * 256 + minor */
  uint32_t serial;
  uint8_t pushes_along;    /* bit 0: x, 1: y, 2: z */
  uint8_t senses_rotation; /* bit 0: roll, 1: tilt, 2: turn */
  uint8_t buttons;
  uint16_t peak_mn, continuous_mn; /* of the force; peak_mn is never exceeded */
  uint32_t step_nm;                /* of the position */
  uint16_t mass_g;
  uint32_t stiffness_n_per_m; /* largest that it renders stably */
  uint16_t damping_mn_s_per_m;
  uint32_t workspace_um[3]; /* half sizes */
  uint16_t telemetry_hz;    /* 1000, or what the line carries: 48 bytes each */
  uint16_t watchdog_ms;     /* 20 */
  uint16_t homing_ms;       /* takes no longer; 0: by hand, without an end */
} tangent_description;

enum { TANGENT_IDLE, TANGENT_HOMING, TANGENT_READY, TANGENT_FAULTED };
enum {
  TANGENT_FINE,
  TANGENT_WATCHDOG,
  TANGENT_ENCODER,
  TANGENT_OVERCURRENT,
  TANGENT_HOMING_FAILED,
  TANGENT_BAD_COMMAND
};

#define TANGENT_LARGEST_FRAME 56

/* Yours to keep; read it, but change nothing in it. */
typedef struct {
  tangent_board board;
  tangent_description is;
  tangent_reading reading;
  uint8_t state, fault;
  float force_n[3]; /* wanted by the host, within the peak */
  uint8_t held[TANGENT_LARGEST_FRAME];
  size_t held_bytes;
  uint16_t next_sequence, heard_sequence, missed_frames;
  uint8_t heard_any, commanded, measured, homing_begins;
  uint32_t command_us, homing_us, telemetry_us;
  uint8_t sent_any;
} tangent_firmware;

void tangent_init(tangent_firmware* f, const tangent_board* board, const tangent_description* is);

/* Bytes from the host, in any portions. */
void tangent_receive(tangent_firmware* f, const uint8_t* bytes, size_t count);

/* Measures, watches, pushes, and sends the position telemetry_hz times a second. now_us: a clock that wraps. */
void tangent_step(tangent_firmware* f, uint32_t now_us);

/* The motors are off until the host clears it: for what the board sees itself, as TANGENT_OVERCURRENT. */
void tangent_fail(tangent_firmware* f, uint8_t fault);

/* The host is gone (USB reset or suspend, DTR down): motors off, to be homed again. */
void tangent_disconnect(tangent_firmware* f);

#ifdef __cplusplus
}
#endif

#endif
