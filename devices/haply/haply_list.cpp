#include "devices/haply/haply_list.h"

#include "devices/haply/haply_codec.h"
#include "devices/haply/haply_link.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace tangent {

namespace {

HaplyProblem problem_of(const HaplyEntry& device) {
  if (device.status.in_use) return HaplyProblem::in_use;
  if (!device.status.usable()) return HaplyProblem::not_started;
  if (!device.own_axes) return HaplyProblem::other_frame;
  return device.problem;
}

/// Of one connection, its first message.
class HaplyLister final : public HaplyLinkHandler {
 public:
  enum class Came : std::uint8_t { nothing, list, no_list, end };

  Came came() const { return came_.load(std::memory_order_acquire); }
  // Once something came, and the link is stopped.
  const HaplyMessage& message() const { return message_; }
  HaplyProblem why() const { return why_; }
  const std::string& detail() const { return detail_; }

 private:
  void on_open() noexcept override {}
  void on_message(std::string_view text) noexcept override {
    if (came() == Came::nothing) settle(read_haply(text, {}, message_) ? Came::list : Came::no_list);
  }
  bool next(std::string&) noexcept override { return false; }
  bool last(std::string&) noexcept override { return false; }
  void on_closed(HaplyProblem why, const std::string& detail) noexcept override {
    if (came() != Came::nothing) return;
    why_ = why;
    detail_ = detail;
    settle(Came::end);
  }
  void settle(Came came) { came_.store(came, std::memory_order_release); }

  std::atomic<Came> came_{Came::nothing};
  HaplyMessage message_;
  HaplyProblem why_ = HaplyProblem::none;
  std::string detail_;
};

}  // namespace

Result<std::vector<FoundDevice>> list_haply_devices(const HaplyOptions& options) {
  using Came = HaplyLister::Came;
  const auto address = read_haply_address(options.address, options.other_host);
  if (!address) return tl::unexpected(address.error());
  HaplyLister lister;
  HaplyLink link(lister);
  const Status started = link.start({.address = *address,
                                     .other_host = options.other_host,
                                     .connect_s = options.connect_s,
                                     .retry_s = options.connect_s,
                                     .largest_message = kHaplyLargestMessage});
  if (!started) return tl::unexpected(started.error());
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.connect_s);
  while (lister.came() == Came::nothing && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Came came = lister.came();  // before the link's own end, which is no word of the service's
  link.stop();
  const std::string where = "Inverse Service at " + options.address;
  if (came == Came::nothing) return tl::unexpected(haply_error(HaplyProblem::silent, where));
  if (came == Came::no_list) return tl::unexpected(haply_error(HaplyProblem::not_understood, where));
  if (came == Came::end) return tl::unexpected(haply_error(lister.why(), where, lister.detail()));
  std::vector<FoundDevice> found;
  for (const HaplyEntry& device : lister.message().devices) {
    const HaplyProblem problem = problem_of(device);
    found.push_back({.kind = "haply", .name = "Haply Inverse3, as its service says", .serial = device.id});
    if (problem != HaplyProblem::none) found.back().problem = haply_error(problem, "Haply Inverse3 " + device.id);
  }
  return found;
}

}  // namespace tangent
