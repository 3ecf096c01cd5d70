// Runs a bring-up on a device: in real time in a thread of its own (or the driver's), or step by step in simulated time
// in the caller's. The owner's thread asks for the view and passes the answers on.
#pragma once

#include "core/base/result.h"
#include "workbench/bringup/bring_up.h"

#include <memory>
#include <string>

namespace tangent {

struct BringUpRunOptions {
  BringUpOptions limits;
  bool threaded = true;         ///< off: `advance` makes the ticks; simulated devices only
  double hangs_after_s = 10.0;  ///< an exchange that is under way for so long is not waited for any more
};

class BringUpRunner {
 public:
  /// Opens the device. Fails with the driver's own words.
  static Result<std::unique_ptr<BringUpRunner>> start(std::unique_ptr<ForceDevice> device,
                                                      const BringUpRunOptions& options);
  /// Zero force, then the device is closed. Leaves it alone, until the process ends, where an exchange does not return.
  ~BringUpRunner();
  BringUpRunner(const BringUpRunner&) = delete;
  BringUpRunner& operator=(const BringUpRunner&) = delete;

  /// The newest; owner's thread.
  const BringUpView& view();
  const ForceCapabilities& capabilities() const;
  /// To the question in the view that was seen last.
  void answer(BringUpAnswer answer);
  void stop();
  /// The driver does not come back from an exchange, so nothing will ever be answered.
  bool hangs() const;
  /// The simulated hand did what is asked, so that an answer makes sense; always with a real device.
  bool settled();
  /// Not threaded: n ticks of simulated time. Else nothing.
  void advance(std::uint64_t ticks);
  std::string link_problem() const;  ///< what the driver says of the cable; empty: nothing

 private:
  struct Impl;
  explicit BringUpRunner(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
