// Model of a contact location display's drive and of the controller on its microcontroller: motor, gear, encoder,
// travel stops, backlash, and a 1 kHz PID. The simulated display and the emulated USB controller both use it.
//
// Pure computation: no clock, no thread. The same calls give the same bits.
//
//   motor      x'' = a u - c x'        u: current, -1 to 1 of the largest
//   encoder    x quantised; the roller follows x through the backlash
//   target     limited in range and speed
//   control    u = (kp (b target - encoder) + ki integral(e) - kd x') / a,  e = target - encoder,  x' from two encoder
//   readings
// The three gains put the poles of the closed loop at w (-1 +- i) / sqrt(2) and -w / 8, where w = 2 pi bandwidth: the
// first two are a Butterworth pair, -3 dB at the bandwidth; the slow third removes the error that friction leaves.
#pragma once

namespace tangent {

struct CldMechanismOptions {
  double travel_m = 20e-3;                    ///< end to end
  double bandwidth_hz = 12.0;                 ///< -3 dB. The paper's: over 5 Hz
  double step_m = 0.8e-6;                     ///< of drive and encoder; 0: exact
  double backlash_m = 20e-6;                  ///< between drive and roller; assumed: makers rarely state it
  double full_acceleration_m_per_s2 = 200.0;  ///< a: of the free drive at the largest current
  double full_current_a = 0.5;                ///< the motor's maximum
  double drag_per_s = 20.0;                   ///< c
};

/// PID gains in SI: acceleration per error, per integrated error, per velocity.
struct CldGains {
  double p_per_s2 = 0.0;
  double i_per_s3 = 0.0;
  double d_per_s = 0.0;
  double target_weight = 1.0;  ///< b: setpoint weight of the proportional part, 0 to 1
};

/// Limits of target and current, in addition to the travel and the motor's maximum.
struct CldLimits {
  double lowest_m = -1.0, highest_m = 1.0;
  double fastest_m_per_s = 0.0;    ///< of the target; 0: unlimited
  double largest_current_a = 0.0;  ///< 0: the motor's maximum
};

/// Gains for the poles above; the derivation is at the definition.
CldGains gains_for(double bandwidth_hz, double drag_per_s);

class CldMechanism {
 public:
  static constexpr double kPeriod_s = 1e-3;  ///< of the controller

  explicit CldMechanism(const CldMechanismOptions& options = {});

  /// Runs one controller period towards `target_m` (clamped to limits and travel).
  void control(double target_m) noexcept;
  /// As above, but with `reading_m` in place of the encoder's reading (a stuck encoder).
  void control(double target_m, double reading_m) noexcept;
  /// One period without current; the drive stops at once (its screw is self-locking).
  void hold() noexcept;
  /// p_per_s2 of 0 selects the gains for the bandwidth. Bumpless: a drive at rest stays at rest.
  void set_gains(const CldGains& gains) noexcept;
  /// In effect from the next control on.
  void set_limits(const CldLimits& limits) noexcept { limits_ = limits; }

  const CldMechanismOptions& options() const { return options_; }
  const CldGains& gains() const { return gains_; }
  double encoder_m() const noexcept;            ///< drive position, quantised
  double drive_m() const { return position_; }  ///< drive position, exact
  double roller_m() const { return roller_; }   ///< behind the backlash
  double current() const { return current_; }   ///< -1 to 1 of the largest

 private:
  void move(double acceleration) noexcept;
  double limited(double target_m) const noexcept;

  CldMechanismOptions options_;
  CldGains gains_;
  CldLimits limits_;
  double target_ = 0.0;  ///< last, after the limits
  double position_ = 0.0, velocity_ = 0.0, roller_ = 0.0, current_ = 0.0;
  double integral_ = 0.0, last_reading_ = 0.0;
};

}  // namespace tangent
