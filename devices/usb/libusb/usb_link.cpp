#include "devices/usb/usb_link.h"

#include "devices/usb/libusb/libusb_find.h"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

namespace tangent {

namespace {

constexpr int kOpenTurn_ms = 5;                 ///< longest sleep while open
constexpr int kClosedTurn_ms = 50;              ///< ... while waiting for the device
constexpr std::int64_t kLook_ns = 500'000'000;  ///< between scans of the bus
constexpr std::int64_t kDrain_ns = 2'000'000'000;

void raise(std::atomic<std::uint64_t>& counter) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace

/// A transfer and its buffer, allocated once.
struct PooledTransfer {
  UsbLink::Impl* owner = nullptr;
  libusb_transfer* transfer = nullptr;
  std::array<unsigned char, LIBUSB_CONTROL_SETUP_SIZE + kUsbPacketBytes> bytes{};
  bool in = false, in_flight = false;
};

struct UsbLink::Impl {
  Impl(UsbLink& l, UsbLinkOptions o, UsbLinkHandler& h, UsbTap* t)
      : link(l), options(std::move(o)), handler(h), tap(t) {}
  ~Impl() {
    if (wake_fd >= 0) ::close(wake_fd);
  }

  UsbLink& link;
  UsbLinkOptions options;
  UsbLinkHandler& handler;
  UsbTap* tap;
  UsbCounters counters;
  std::atomic<bool> connected{false}, stopping{false};
  std::atomic<UsbProblem> problem{UsbProblem::not_attached};
  // As long as the link, not as its thread: who wakes it while it is stopped must not write to a descriptor that was
  // closed, and is perhaps another file by now.
  const int wake_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::thread thread;

  // Link's thread only.
  LibusbContext context;
  LibusbHandle handle;
  std::string serial;                ///< of the device that is open
  std::vector<PooledTransfer> pool;  ///< IN transfers first
  std::vector<pollfd> polled;
  bool polled_stale = true, lost = false, hotplug = false, look_now = true;
  libusb_hotplug_callback_handle hotplug_handle = 0;
  std::int64_t next_look_ns = 0;

  Status start();
  void stop();
  void run() noexcept;
  void make_pool();
  void free_pool() noexcept;
  void watch_hotplug();
  void refresh_polled();
  void wait(int timeout_ms) noexcept;
  void try_open() noexcept;
  void close() noexcept;
  bool submit(PooledTransfer& t) noexcept;
  void completed(PooledTransfer& t) noexcept;
  void received(PooledTransfer& t) noexcept;
  PooledTransfer* free_transfer() noexcept;
  bool any_free() const noexcept;
  bool any_in_flight() const noexcept;
  bool sends_in_flight() const noexcept;
};

namespace {

void LIBUSB_CALL on_completed(libusb_transfer* transfer);
int LIBUSB_CALL on_hotplug(libusb_context*, libusb_device*, libusb_hotplug_event, void* user);

}  // namespace

// --- Starting and stopping -----------------------------------------------------------------------------

Status UsbLink::Impl::start() {
  if (thread.joinable()) return {};
  if (wake_fd < 0) return fail("no event descriptor is left", "USB", "close other programs");
  auto opened = open_libusb();
  if (!opened) return tl::unexpected(opened.error());
  context = std::move(*opened);
  make_pool();
  watch_hotplug();
  libusb_set_pollfd_notifiers(
      context.get(), [](int, short, void* user) { static_cast<Impl*>(user)->polled_stale = true; },
      [](int, void* user) { static_cast<Impl*>(user)->polled_stale = true; }, this);
  stopping.store(false);
  look_now = true;
  thread = std::thread([this]() noexcept { run(); });
  return {};
}

void UsbLink::Impl::stop() {
  if (!thread.joinable()) return;
  stopping.store(true);
  link.wake();
  thread.join();
  libusb_set_pollfd_notifiers(context.get(), nullptr, nullptr, nullptr);
  if (hotplug) libusb_hotplug_deregister_callback(context.get(), hotplug_handle);
  hotplug = false;
  free_pool();
  context.reset();
}

void UsbLink::Impl::make_pool() {
  const auto ins = static_cast<std::size_t>(options.in_endpoint != 0 ? options.in_transfers : 0);
  pool.resize(ins + static_cast<std::size_t>(options.out_transfers));
  for (std::size_t i = 0; i < pool.size(); ++i) {
    pool[i].owner = this;
    pool[i].transfer = libusb_alloc_transfer(0);
    pool[i].in = i < ins;
  }
}

void UsbLink::Impl::free_pool() noexcept {
  for (PooledTransfer& t : pool) {
    if (!t.in_flight) libusb_free_transfer(t.transfer);
  }
  pool.clear();
}

void UsbLink::Impl::watch_hotplug() {
  if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG) == 0) return;
  const int vendor = options.match.vendor != 0 ? options.match.vendor : LIBUSB_HOTPLUG_MATCH_ANY;
  hotplug = libusb_hotplug_register_callback(context.get(),
                                             LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT,
                                             LIBUSB_HOTPLUG_NO_FLAGS, vendor, LIBUSB_HOTPLUG_MATCH_ANY,
                                             LIBUSB_HOTPLUG_MATCH_ANY, &on_hotplug, this, &hotplug_handle) == 0;
}

// --- The thread ----------------------------------------------------------------------------------------

void UsbLink::Impl::run() noexcept {
  pthread_setname_np(pthread_self(), "usb");
  while (!stopping.load(std::memory_order_relaxed)) {
    if (!handle) try_open();
    wait(handle ? kOpenTurn_ms : kClosedTurn_ms);
    timeval none{0, 0};
    libusb_handle_events_timeout_completed(context.get(), &none, nullptr);
    if (handle && !lost) handler.on_turn(link, usb_now_ns());
    if (handle && lost) close();
  }
  if (handle) {
    // Sends what was queued last (a stop command) before the other transfers are cancelled.
    handler.on_turn(link, usb_now_ns());
    const std::int64_t give_up = usb_now_ns() + options.time_out_ms * std::int64_t{1'000'000};
    while (!lost && sends_in_flight() && usb_now_ns() < give_up) {
      timeval turn{0, 5'000};
      libusb_handle_events_timeout_completed(context.get(), &turn, nullptr);
    }
    close();
  }
}

void UsbLink::Impl::refresh_polled() {
  polled_stale = false;
  polled.assign(1, {wake_fd, POLLIN, 0});
  const libusb_pollfd** list = libusb_get_pollfds(context.get());
  for (const libusb_pollfd** fd = list; fd != nullptr && *fd != nullptr; ++fd)
    polled.push_back({(*fd)->fd, (*fd)->events, 0});
  libusb_free_pollfds(list);
}

void UsbLink::Impl::wait(int timeout_ms) noexcept {
  if (polled_stale) refresh_polled();
  if (::poll(polled.data(), polled.size(), timeout_ms) <= 0) return;
  if ((polled[0].revents & POLLIN) != 0) {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = ::read(wake_fd, &count, sizeof count);
  }
}

void UsbLink::Impl::try_open() noexcept {
  const std::int64_t now = usb_now_ns();
  // Also scans twice a second: udev may not have set the permissions yet when hot-plug reports a device.
  if (!look_now && now < next_look_ns) return;
  look_now = false;
  next_look_ns = now + kLook_ns;
  UsbProblem why = UsbProblem::none;
  handle = open_first(context.get(), options.match, options.interface_number, why);
  problem.store(why, std::memory_order_relaxed);
  if (!handle) return;
  lost = false;
  serial = !options.ask_serial            ? std::string()
           : options.match.serial.empty() ? serial_of(handle.get())
                                          : options.match.serial;
  raise(counters.connects);
  for (PooledTransfer& t : pool) {
    if (!t.in) continue;
    libusb_fill_interrupt_transfer(t.transfer, handle.get(), options.in_endpoint, t.bytes.data(), kUsbPacketBytes,
                                   &on_completed, &t, 0);
    if (options.bulk) t.transfer->type = LIBUSB_TRANSFER_TYPE_BULK;
    submit(t);
  }
  if (lost) {
    close();
    return;
  }
  connected.store(true, std::memory_order_release);
  handler.on_open(link);
}

void UsbLink::Impl::close() noexcept {
  connected.store(false, std::memory_order_release);
  lost = true;  // from here on completed transfers are not resubmitted
  for (PooledTransfer& t : pool) {
    if (t.in_flight) libusb_cancel_transfer(t.transfer);
  }
  const std::int64_t give_up = usb_now_ns() + kDrain_ns;
  while (any_in_flight() && usb_now_ns() < give_up) {
    timeval turn{0, 10'000};
    libusb_handle_events_timeout_completed(context.get(), &turn, nullptr);
  }
  if (options.interface_number >= 0) libusb_release_interface(handle.get(), options.interface_number);
  handle.reset();
  problem.store(UsbProblem::not_attached, std::memory_order_relaxed);
  handler.on_closed();
  next_look_ns = usb_now_ns() + kClosedTurn_ms * 1'000'000;
  look_now = false;
}

// --- Transfers -----------------------------------------------------------------------------------------

bool UsbLink::Impl::any_free() const noexcept {
  return std::any_of(pool.begin(), pool.end(), [](const PooledTransfer& t) { return !t.in && !t.in_flight; });
}

bool UsbLink::Impl::any_in_flight() const noexcept {
  return std::any_of(pool.begin(), pool.end(), [](const PooledTransfer& t) { return t.in_flight; });
}

bool UsbLink::Impl::sends_in_flight() const noexcept {
  return std::any_of(pool.begin(), pool.end(), [](const PooledTransfer& t) { return !t.in && t.in_flight; });
}

PooledTransfer* UsbLink::Impl::free_transfer() noexcept {
  for (PooledTransfer& t : pool) {
    if (!t.in && !t.in_flight) return &t;
  }
  raise(counters.refused_sends);
  return nullptr;
}

bool UsbLink::Impl::submit(PooledTransfer& t) noexcept {
  const int code = libusb_submit_transfer(t.transfer);
  t.in_flight = code == 0;
  if (code == 0) return true;
  raise(counters.errors);
  if (code == LIBUSB_ERROR_NO_DEVICE || t.in) lost = true;
  return false;
}

void UsbLink::Impl::received(PooledTransfer& t) noexcept {
  const auto length = static_cast<std::size_t>(t.transfer->actual_length);
  raise(counters.packets_in);
  if (length == 0) raise(counters.empty_packets);
  const std::int64_t now = usb_now_ns();
  const std::span<const std::uint8_t> bytes(t.bytes.data(), length);
  if (tap != nullptr) tap->packet(UsbTap::Direction::in, now, bytes, t.transfer->status);
  if (length > 0) handler.on_packet(link, bytes, now);
}

void UsbLink::Impl::completed(PooledTransfer& t) noexcept {
  t.in_flight = false;
  const auto status = t.transfer->status;
  const bool control = t.transfer->type == LIBUSB_TRANSFER_TYPE_CONTROL;
  switch (status) {
    case LIBUSB_TRANSFER_COMPLETED:
      break;
    case LIBUSB_TRANSFER_CANCELLED:
      return;
    case LIBUSB_TRANSFER_NO_DEVICE:
      lost = true;
      return;
    case LIBUSB_TRANSFER_STALL:
      raise(counters.stalls);
      // Blocks for one answer of the device; the servo never waits for this thread.
      if (!control && !lost) libusb_clear_halt(handle.get(), t.transfer->endpoint);
      break;
    case LIBUSB_TRANSFER_TIMED_OUT:
      raise(counters.time_outs);
      break;
    default:
      raise(counters.errors);
      break;
  }
  if (lost) return;
  if (t.in) {
    if (status == LIBUSB_TRANSFER_COMPLETED) received(t);
    if (!lost) submit(t);
    return;
  }
  const int sent = t.transfer->length - (control ? static_cast<int>(LIBUSB_CONTROL_SETUP_SIZE) : 0);
  if (status == LIBUSB_TRANSFER_COMPLETED && t.transfer->actual_length < sent) raise(counters.short_packets);
  if (control) {
    handler.on_control_done(link, status == LIBUSB_TRANSFER_COMPLETED, usb_now_ns());
  }
}

namespace {

void LIBUSB_CALL on_completed(libusb_transfer* transfer) {
  auto& t = *static_cast<PooledTransfer*>(transfer->user_data);
  t.owner->completed(t);
}

int LIBUSB_CALL on_hotplug(libusb_context*, libusb_device* device, libusb_hotplug_event event, void* user) {
  auto& impl = *static_cast<UsbLink::Impl*>(user);
  if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED)
    impl.look_now = true;
  else if (impl.handle && libusb_get_device(impl.handle.get()) == device)
    impl.lost = true;
  return 0;
}

}  // namespace

// --- Link ----------------------------------------------------------------------------------------------

UsbLink::UsbLink(UsbLinkOptions options, UsbLinkHandler& handler, UsbTap* tap)
    : impl_(std::make_unique<Impl>(*this, std::move(options), handler, tap)) {}
UsbLink::~UsbLink() { impl_->stop(); }

Status UsbLink::start() { return impl_->start(); }
void UsbLink::stop() { impl_->stop(); }

void UsbLink::wake() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t put = ::write(impl_->wake_fd, &one, sizeof one);
}

bool UsbLink::connected() const noexcept { return impl_->connected.load(std::memory_order_acquire); }
UsbProblem UsbLink::problem() const noexcept { return impl_->problem.load(std::memory_order_relaxed); }
const UsbCounters& UsbLink::counters() const noexcept { return impl_->counters; }
void UsbLink::reconnect() noexcept { impl_->lost = true; }
const std::string& UsbLink::serial() const noexcept { return impl_->serial; }
bool UsbLink::can_send() const noexcept { return impl_->handle && !impl_->lost && impl_->any_free(); }

bool UsbLink::send(std::span<const std::uint8_t> bytes) noexcept {
  if (!impl_->handle || impl_->lost) return false;
  PooledTransfer* t = impl_->free_transfer();
  if (t == nullptr) return false;
  std::copy(bytes.begin(), bytes.end(), t->bytes.begin());
  libusb_fill_interrupt_transfer(t->transfer, impl_->handle.get(), impl_->options.out_endpoint, t->bytes.data(),
                                 static_cast<int>(bytes.size()), &on_completed, t, impl_->options.time_out_ms);
  if (impl_->options.bulk) t->transfer->type = LIBUSB_TRANSFER_TYPE_BULK;
  if (impl_->tap != nullptr) impl_->tap->packet(UsbTap::Direction::out, usb_now_ns(), bytes, 0);
  raise(impl_->counters.packets_out);
  return impl_->submit(*t);
}

bool UsbLink::send_control(const UsbControl& control) noexcept {
  if (!impl_->handle || impl_->lost) return false;
  PooledTransfer* t = impl_->free_transfer();
  if (t == nullptr) return false;
  libusb_fill_control_setup(t->bytes.data(), control.request_type, control.request, control.value, control.index, 0);
  libusb_fill_control_transfer(t->transfer, impl_->handle.get(), t->bytes.data(), &on_completed, t,
                               impl_->options.time_out_ms);
  if (impl_->tap != nullptr) {
    impl_->tap->packet(UsbTap::Direction::control, usb_now_ns(), {t->bytes.data(), LIBUSB_CONTROL_SETUP_SIZE}, 0);
  }
  raise(impl_->counters.controls);
  return impl_->submit(*t);
}

}  // namespace tangent
