// Runs a guided run (a bring-up, a calibration) on a device: in real time in a thread of its own (or the driver's), or
// step by step in simulated time in the caller's. The owner's thread asks for the view and passes the answers on.
//
// Machine: Options (with rate_hz), View (with ended, questions, sent_n, end_with), Answer; tick, answer, stop, view.
#pragma once

#include "core/base/result.h"
#include "devices/force_device.h"

#include <memory>
#include <string>

namespace tangent {

template <class Machine>
struct GuidedRunOptions {
  typename Machine::Options limits = {};
  bool threaded = true;         ///< off: `advance` makes the ticks; simulated devices only
  double hangs_after_s = 10.0;  ///< an exchange that is under way for so long ends the run: it is not waited for
};

template <class Machine>
class GuidedRunner {
 public:
  using View = typename Machine::View;

  /// Opens the device. Fails with the driver's own words.
  static Result<std::unique_ptr<GuidedRunner>> start(std::unique_ptr<ForceDevice> device,
                                                     const GuidedRunOptions<Machine>& options);
  /// Zero force, then the device is closed. Leaves it alone, until the process ends, where an exchange does not return.
  ~GuidedRunner();
  GuidedRunner(const GuidedRunner&) = delete;
  GuidedRunner& operator=(const GuidedRunner&) = delete;

  /// The newest; owner's thread. Ended for good, with `hangs`, where the driver does not come back from an exchange:
  /// its emergency stop was called long before.
  const View& view();
  const ForceCapabilities& capabilities() const;
  /// To the question in the view that was seen last.
  void answer(typename Machine::Answer answer);
  void stop();
  /// Of the device on the cable; empty: it has none, or none is known.
  std::string serial() const;
  /// The simulated hand did what the view that was seen last asks, so that an answer makes sense; always with a real
  /// device.
  bool settled() const;
  /// Not threaded: n ticks of simulated time. Else nothing.
  void advance(std::uint64_t ticks);
  std::string link_problem() const;  ///< what the driver says of the cable; empty: nothing

 private:
  struct Impl;
  explicit GuidedRunner(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
