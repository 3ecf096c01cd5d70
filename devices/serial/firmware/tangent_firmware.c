#include "tangent_firmware.h"

#include <string.h>

enum { SYNC = 0xC5, FRAME_VERSION = 1, FORCE_VERSION = 1, HEADER = 6, CRC = 2, LARGEST_PAYLOAD = 48 };
enum { FORCE_HELLO = 0x10, FORCE_COMMAND = 0x11, REFUSED = 0x83, FORCE_INFO = 0x90, FORCE_TELEMETRY = 0x91 };
enum { BAD_VERSION = 1, BAD_TYPE, BAD_LENGTH, BAD_VALUE, BAD_STATE };
enum { NOTHING, HOME, STOP, CLEAR_FAULT };

static const int32_t not_measured = -2147483647 - 1;

/* --- Bytes ------------------------------------------------------------------------------------------ */

static uint16_t read_u16(const uint8_t* at) { return (uint16_t)(at[0] | ((unsigned)at[1] << 8)); }

static int32_t read_i32(const uint8_t* at) {
  const uint32_t bits = (uint32_t)at[0] | ((uint32_t)at[1] << 8) | ((uint32_t)at[2] << 16) | ((uint32_t)at[3] << 24);
  int32_t value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static uint8_t* put(uint8_t* at, uint32_t value, int bytes) {
  for (; bytes > 0; --bytes, value >>= 8) *at++ = (uint8_t)(value & 0xffu);
  return at;
}

static uint16_t crc_of(const uint8_t* bytes, size_t count) {
  uint16_t crc = 0xffff;
  size_t i;
  int bit;
  for (i = 0; i < count; ++i) {
    crc = (uint16_t)(crc ^ ((unsigned)bytes[i] << 8));
    for (bit = 0; bit < 8; ++bit) {
      const unsigned twice = (unsigned)crc << 1;
      crc = (uint16_t)((crc & 0x8000u) != 0 ? twice ^ 0x1021u : twice);
    }
  }
  return crc;
}

/* The payload lies at frame + HEADER already. */
static void send_frame(tangent_firmware* f, uint8_t* frame, uint8_t type, size_t length) {
  frame[0] = SYNC;
  frame[1] = FRAME_VERSION;
  frame[2] = type;
  frame[3] = (uint8_t)length;
  put(frame + 4, f->next_sequence++, 2);
  put(frame + HEADER + length, crc_of(frame + 1, HEADER - 1 + length), 2);
  f->board.send(f->board.context, frame, HEADER + length + CRC);
}

/* --- To the host ------------------------------------------------------------------------------------ */

static void send_refused(tangent_firmware* f, uint8_t type, uint16_t sequence, uint8_t reason) {
  uint8_t frame[HEADER + 4 + CRC], *at = frame + HEADER;
  at = put(at, type, 1);
  at = put(at, sequence, 2);
  at = put(at, reason, 1);
  send_frame(f, frame, REFUSED, (size_t)(at - frame) - HEADER);
}

static void send_info(tangent_firmware* f) {
  uint8_t frame[TANGENT_LARGEST_FRAME], *at = frame + HEADER;
  int axis;
  at = put(at, FORCE_VERSION, 1);
  at = put(at, f->is.firmware_version, 2);
  at = put(at, f->is.serial, 4);
  at = put(at, f->is.pushes_along, 1);
  at = put(at, f->is.senses_rotation, 1);
  at = put(at, f->is.buttons, 1);
  at = put(at, f->is.peak_mn, 2);
  at = put(at, f->is.continuous_mn, 2);
  at = put(at, f->is.step_nm, 4);
  at = put(at, f->is.mass_g, 2);
  at = put(at, f->is.stiffness_n_per_m, 4);
  at = put(at, f->is.damping_mn_s_per_m, 2);
  for (axis = 0; axis < 3; ++axis) at = put(at, f->is.workspace_um[axis], 4);
  at = put(at, f->is.telemetry_hz, 2);
  at = put(at, f->is.watchdog_ms, 2);
  at = put(at, f->is.homing_ms, 2);
  send_frame(f, frame, FORCE_INFO, (size_t)(at - frame) - HEADER);
}

/* Comparisons with a NaN are false; a float beyond an integer's range must not be converted. */
static int32_t scaled(float value, float scale, float most) {
  const float x = value * scale;
  if (!(x >= -most && x <= most)) return x > 0 ? (int32_t)most : -(int32_t)most;
  return (int32_t)(x + (x < 0 ? -0.5f : 0.5f));
}

static void send_telemetry(tangent_firmware* f, uint32_t now_us) {
  uint8_t frame[TANGENT_LARGEST_FRAME], *at = frame + HEADER;
  int i;
  at = put(at, now_us, 4);
  for (i = 0; i < 3; ++i) {
    const int32_t nm = f->measured ? scaled(f->reading.position_m[i], 1e9f, 2.0e9f) : not_measured;
    at = put(at, (uint32_t)nm, 4);
  }
  for (i = 0; i < 3; ++i) {
    const float force_n = f->state == TANGENT_READY ? f->force_n[i] : 0.0f;
    at = put(at, (uint32_t)scaled(force_n, 1e3f, 32767.0f), 2);
  }
  for (i = 0; i < 4; ++i) at = put(at, (uint32_t)scaled(f->reading.orientation[i], 32767.0f, 32767.0f), 2);
  at = put(at, f->reading.buttons, 4);
  at = put(at, f->state, 1);
  at = put(at, f->fault, 1);
  at = put(at, f->heard_sequence, 2);
  at = put(at, f->missed_frames, 2);
  send_frame(f, frame, FORCE_TELEMETRY, (size_t)(at - frame) - HEADER);
}

/* --- States ----------------------------------------------------------------------------------------- */

static void push_nothing(tangent_firmware* f) {
  static const float nothing[3] = {0.0f, 0.0f, 0.0f};
  memcpy(f->force_n, nothing, sizeof nothing);
  f->board.push(f->board.context, nothing);
}

static void leave_for(tangent_firmware* f, uint8_t state, uint8_t fault) {
  f->state = state;
  f->fault = fault;
  push_nothing(f);
}

void tangent_fail(tangent_firmware* f, uint8_t fault) {
  if (f->state != TANGENT_FAULTED) leave_for(f, TANGENT_FAULTED, fault);
}

void tangent_disconnect(tangent_firmware* f) {
  f->held_bytes = 0;
  f->heard_any = 0;
  leave_for(f, TANGENT_IDLE, TANGENT_FINE);
}

void tangent_init(tangent_firmware* f, const tangent_board* board, const tangent_description* is) {
  memset(f, 0, sizeof *f);
  f->board = *board;
  f->is = *is;
  f->reading.orientation[0] = 1.0f;
  leave_for(f, TANGENT_IDLE, TANGENT_FINE);
}

/* 0: not in this state. */
static int carry_out(tangent_firmware* f, uint8_t request) {
  if (request == HOME) {
    if (f->state != TANGENT_IDLE && f->state != TANGENT_READY) return 0;
    leave_for(f, TANGENT_HOMING, TANGENT_FINE);
    f->homing_begins = 1;
  } else if (request == STOP) {
    if (f->state != TANGENT_FAULTED) leave_for(f, TANGENT_IDLE, TANGENT_FINE);
  } else if (request == CLEAR_FAULT) {
    if (f->state != TANGENT_FAULTED) return 0;
    leave_for(f, TANGENT_IDLE, TANGENT_FINE);
  }
  return 1;
}

/* --- From the host ---------------------------------------------------------------------------------- */

/* Newton's iteration from above; enough for a limit. */
static float root_of(float square) {
  float x = square > 1.0f ? square : 1.0f;
  int i;
  for (i = 0; i < 24; ++i) x = 0.5f * (x + square / x);
  return x;
}

static void take_force(tangent_firmware* f, const uint8_t* payload) {
  const float peak_n = 1e-3f * (float)f->is.peak_mn;
  float square = 0.0f, force[3], length;
  int i;
  for (i = 0; i < 3; ++i) {
    force[i] = ((f->is.pushes_along >> i) & 1) != 0 ? 1e-6f * (float)read_i32(payload + 4 * i) : 0.0f;
    square += force[i] * force[i];
  }
  length = root_of(square);
  for (i = 0; i < 3; ++i) f->force_n[i] = length > peak_n ? force[i] * (peak_n / length) : force[i];
}

static uint8_t take_command(tangent_firmware* f, const uint8_t* payload) {
  if (payload[12] > CLEAR_FAULT) return BAD_VALUE;
  if (!carry_out(f, payload[12])) return BAD_STATE;
  f->commanded = 1;
  if (f->state == TANGENT_READY) take_force(f, payload);
  return 0;
}

/* Answers 0 or the reason to refuse. */
static uint8_t take_frame(tangent_firmware* f, const uint8_t* frame) {
  const uint8_t* payload = frame + HEADER;
  const uint16_t sequence = read_u16(frame + 4);
  const uint16_t ahead = (uint16_t)(sequence - f->heard_sequence);
  if (frame[1] != FRAME_VERSION) return BAD_VERSION;
  if (frame[2] == FORCE_HELLO) {
    if (frame[3] != 2) return BAD_LENGTH;
    if (payload[0] > FORCE_VERSION || payload[1] < FORCE_VERSION) return BAD_VERSION;
    f->heard_any = 1; /* a host that has just come counts from anywhere */
    f->heard_sequence = sequence;
    send_info(f);
    return 0;
  }
  if (frame[2] != FORCE_COMMAND) return BAD_TYPE;
  if (frame[3] != 13) return BAD_LENGTH;
  if (f->heard_any && (ahead == 0 || ahead > 0x7fff)) return 0; /* came before: an old force is not pushed */
  if (f->heard_any) f->missed_frames = (uint16_t)(f->missed_frames + ahead - 1);
  f->heard_any = 1;
  f->heard_sequence = sequence;
  return take_command(f, payload);
}

static void drop(tangent_firmware* f, size_t count) {
  f->held_bytes -= count;
  memmove(f->held, f->held + count, f->held_bytes);
}

/* Takes whole frames out of what is held; what is none is skipped from its sync byte on, and what follows looked at
 * again: one bad byte doesn't lose the good frame behind it. */
static void take_frames(tangent_firmware* f) {
  size_t body, before;
  uint8_t reason, type;
  uint16_t sequence;
  for (;;) {
    for (before = 0; before < f->held_bytes && f->held[before] != SYNC; ++before) {}
    if (before > 0) drop(f, before);
    if (f->held_bytes < HEADER) return;
    body = (size_t)HEADER + f->held[3];
    if (f->held[3] > LARGEST_PAYLOAD) {
      drop(f, 1);
      continue;
    }
    if (f->held_bytes < body + CRC) return;
    if (crc_of(f->held + 1, body - 1) != read_u16(f->held + body)) {
      drop(f, 1);
      continue;
    }
    type = f->held[2];
    sequence = read_u16(f->held + 4);
    reason = take_frame(f, f->held);
    if (reason != 0) send_refused(f, type, sequence, reason);
    drop(f, body + CRC);
  }
}

void tangent_receive(tangent_firmware* f, const uint8_t* bytes, size_t count) {
  for (; count > 0; --count) {
    f->held[f->held_bytes++] = *bytes++; /* has room: take_frames takes or drops what is full */
    take_frames(f);
  }
}

/* --- Every step ------------------------------------------------------------------------------------- */

/* Comparisons with a NaN are false. Positions within 2 m fit into the message. */
static int is_sound(const tangent_reading* r) {
  int i, sound = 1;
  for (i = 0; i < 3; ++i) sound = sound && r->position_m[i] > -2.0f && r->position_m[i] < 2.0f;
  for (i = 0; i < 4; ++i) sound = sound && r->orientation[i] >= -1.001f && r->orientation[i] <= 1.001f;
  return sound;
}

static void watch(tangent_firmware* f, uint32_t now_us) {
  const uint32_t watchdog_us = (uint32_t)1000 * f->is.watchdog_ms, homing_us = (uint32_t)1000 * f->is.homing_ms;
  if (f->commanded || f->state != TANGENT_READY) f->command_us = now_us;
  f->commanded = 0;
  if (f->state == TANGENT_READY && now_us - f->command_us > watchdog_us) tangent_fail(f, TANGENT_WATCHDOG);
  if (f->state != TANGENT_HOMING || f->homing_begins) f->homing_us = now_us;
  f->homing_begins = 0;
  if (homing_us > 0 && now_us - f->homing_us > homing_us) tangent_fail(f, TANGENT_HOMING_FAILED);
}

static void go_on_homing(tangent_firmware* f) {
  const int done = f->board.home(f->board.context);
  if (done > 0) leave_for(f, TANGENT_READY, TANGENT_FINE);
  if (done < 0) tangent_fail(f, TANGENT_HOMING_FAILED);
}

void tangent_step(tangent_firmware* f, uint32_t now_us) {
  const uint32_t period_us = f->is.telemetry_hz > 0 ? 1000000u / f->is.telemetry_hz : 1000u;
  watch(f, now_us);
  if (f->state == TANGENT_HOMING) go_on_homing(f);
  f->measured = (uint8_t)(f->board.measure(f->board.context, &f->reading) != 0 && is_sound(&f->reading));
  if (!f->measured && (f->state == TANGENT_READY || f->state == TANGENT_HOMING)) tangent_fail(f, TANGENT_ENCODER);
  if (f->state == TANGENT_READY) f->board.push(f->board.context, f->force_n);
  if (f->sent_any && now_us - f->telemetry_us < period_us) return;
  f->telemetry_us = f->sent_any && now_us - f->telemetry_us < 2u * period_us ? f->telemetry_us + period_us : now_us;
  f->sent_any = 1;
  send_telemetry(f, now_us);
}
