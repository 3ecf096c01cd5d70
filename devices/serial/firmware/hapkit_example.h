/* A Hapkit as a force device with one axis: a motor's pulley turns a sector, whose handle the finger holds.
 *
 *   position = r_handle (r_pulley / r_sector) angle of the motor
 *   torque of the motor = force r_handle r_pulley / r_sector
 * The second follows from the first: the motor's power is the finger's. It lies on its side here, so that the handle
 * moves up and down, along z. Give it the three functions at the end, and call the others from the main loop. */
#ifndef TANGENT_HAPKIT_EXAMPLE_H
#define TANGENT_HAPKIT_EXAMPLE_H

#include "tangent_firmware.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of your own kit: measure them. */
typedef struct {
  float handle_m, sector_m, pulley_m; /* radii */
  float counts_per_turn;              /* of the encoder, on the motor's shaft */
  float torque_at_full_duty_nm;       /* of the motor at standstill, at the driver's voltage */
} hapkit_geometry;

float hapkit_position_m(const hapkit_geometry* g, int32_t counts);
float hapkit_torque_nm(const hapkit_geometry* g, float force_n);
/* -1 to 1: what is beyond is cut off. */
float hapkit_duty(const hapkit_geometry* g, float force_n);

typedef struct {
  hapkit_geometry geometry;
  int32_t zero_counts;
  tangent_firmware firmware;
} hapkit;

/* peak_n: no more than hapkit_duty can give. */
void hapkit_init(hapkit* kit, const hapkit_geometry* geometry, float peak_n, uint32_t serial);

/* Yours: 0 when the encoder does not answer; the motor's PWM and direction; the USB serial port. */
int hapkit_read_counts(int32_t* counts);
void hapkit_set_duty(float duty);
void hapkit_send(const uint8_t* bytes, size_t count);

#ifdef __cplusplus
}
#endif

#endif
