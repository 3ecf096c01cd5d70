// The WebSocket, by Boost.Beast: the only source that includes it, and compiled by itself.
#include "devices/haply/haply_link.h"

#include "devices/base/realtime_thread.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket.hpp>

#include <fcntl.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <pthread.h>

#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace tangent {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using tcp = asio::ip::tcp;
using Failure = boost::system::error_code;

constexpr std::chrono::milliseconds kTurn{5}, kGoodbye{200};

std::chrono::nanoseconds span_of(double seconds) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

/// Handlers that are still under way keep it, after it was given up as well.
struct Connection {
  explicit Connection(asio::io_context& io) : ws(io) {}
  websocket::stream<beast::tcp_stream> ws;
  beast::flat_buffer heard;
  std::string sending;
  bool open = false, sends = false, leaving = false, said_last = false;
};
using ConnectionPtr = std::shared_ptr<Connection>;

}  // namespace

bool haply_built_in() { return true; }

struct HaplyLink::Impl {
  explicit Impl(HaplyLinkHandler& to) : handler(to) {}

  HaplyLinkHandler& handler;
  HaplyLinkOptions options;
  asio::io_context io{1};
  tcp::resolver resolver{io};
  asio::steady_timer turn{io}, later{io}, goodbye{io};
  asio::posix::stream_descriptor bell{io};
  std::array<char, 8> rings{};
  ConnectionPtr now;
  std::thread thread;
  std::atomic<bool> stopping{false}, anew{false};

  void run() noexcept;
  void connect();
  void resolved(const ConnectionPtr& c, const tcp::resolver::results_type& found);
  void shake_hands(const ConnectionPtr& c);
  void opened(const ConnectionPtr& c);
  void read(const ConnectionPtr& c);
  void send_next(const ConnectionPtr& c);
  void write(const ConnectionPtr& c);
  void leave(const ConnectionPtr& c);
  void bid_farewell(const ConnectionPtr& c);
  void left(const ConnectionPtr& c);
  void lose(const ConnectionPtr& c, HaplyProblem why, const Failure& cause);
  void listen_for_bell();
  void listen_for_turn();
  void look_around();
  bool is_ours(const ConnectionPtr& c) const { return c == now; }
};

// --- Connecting ----------------------------------------------------------------------------------------

void HaplyLink::Impl::connect() {
  if (stopping) return;
  anew = false;
  now = std::make_shared<Connection>(io);
  resolver.async_resolve(options.address.host, options.address.port,
                         [this, c = now](const Failure& failed, const tcp::resolver::results_type& found) {
                           if (!is_ours(c)) return;
                           if (failed) return lose(c, HaplyProblem::no_service, failed);
                           resolved(c, found);
                         });
}

void HaplyLink::Impl::resolved(const ConnectionPtr& c, const tcp::resolver::results_type& found) {
  std::vector<tcp::endpoint> here;
  for (const auto& entry : found) {
    if (options.other_host || entry.endpoint().address().is_loopback()) here.push_back(entry.endpoint());
  }
  if (here.empty()) return lose(c, HaplyProblem::other_host, {});
  beast::tcp_stream& socket = beast::get_lowest_layer(c->ws);
  socket.expires_after(span_of(options.connect_s));
  socket.async_connect(here, [this, c](const Failure& failed, const tcp::endpoint&) {
    if (!is_ours(c)) return;
    if (failed) return lose(c, HaplyProblem::no_service, failed);
    shake_hands(c);
  });
}

void HaplyLink::Impl::shake_hands(const ConnectionPtr& c) {
  beast::tcp_stream& socket = beast::get_lowest_layer(c->ws);
  Failure ignored;
  socket.socket().set_option(tcp::no_delay(true), ignored);
  socket.expires_never();  // the WebSocket has times of its own
  websocket::stream_base::timeout times{};
  times.handshake_timeout = span_of(options.connect_s);
  times.idle_timeout = websocket::stream_base::none();
  times.keep_alive_pings = false;
  c->ws.set_option(times);
  c->ws.read_message_max(options.largest_message);
  c->ws.async_handshake(options.address.host + ":" + options.address.port, "/", [this, c](const Failure& failed) {
    if (!is_ours(c)) return;
    if (failed) return lose(c, HaplyProblem::no_websocket, failed);
    opened(c);
  });
}

void HaplyLink::Impl::opened(const ConnectionPtr& c) {
  c->open = true;
  c->ws.text(true);
  handler.on_open();
  read(c);
}

// --- Messages ------------------------------------------------------------------------------------------

void HaplyLink::Impl::read(const ConnectionPtr& c) {
  c->ws.async_read(c->heard, [this, c](const Failure& failed, std::size_t) {
    if (!is_ours(c)) return;
    if (failed == websocket::error::message_too_big) return lose(c, HaplyProblem::too_long, {});
    if (failed) return lose(c, HaplyProblem::closed, failed);
    handler.on_message({static_cast<const char*>(c->heard.data().data()), c->heard.size()});
    c->heard.consume(c->heard.size());
    send_next(c);
    read(c);
  });
}

void HaplyLink::Impl::send_next(const ConnectionPtr& c) {
  if (!c->open || c->sends || c->leaving) return;
  if (handler.next(c->sending)) write(c);
}

void HaplyLink::Impl::write(const ConnectionPtr& c) {
  c->sends = true;
  c->ws.async_write(asio::buffer(c->sending), [this, c](const Failure& failed, std::size_t) {
    c->sends = false;
    if (!is_ours(c)) return;
    if (failed) return lose(c, HaplyProblem::closed, failed);
    if (c->leaving) return leave(c);
    send_next(c);
  });
}

// --- Ending --------------------------------------------------------------------------------------------

/// The last message, then the WebSocket's own farewell, then the end, whatever comes of them. Called again when what
/// is being written has gone out.
void HaplyLink::Impl::leave(const ConnectionPtr& c) {
  if (!c->open) return left(c);
  if (!std::exchange(c->leaving, true)) {
    goodbye.expires_after(kGoodbye);
    goodbye.async_wait([this, c](const Failure& failed) {
      if (!failed) left(c);
    });
  }
  if (c->sends || std::exchange(c->said_last, true)) return;
  if (!handler.last(c->sending)) return bid_farewell(c);
  c->sends = true;
  c->ws.async_write(asio::buffer(c->sending), [this, c](const Failure&, std::size_t) {
    c->sends = false;
    if (is_ours(c)) bid_farewell(c);
  });
}

void HaplyLink::Impl::bid_farewell(const ConnectionPtr& c) {
  c->ws.async_close(websocket::close_code::normal, [this, c](const Failure&) { left(c); });
}

void HaplyLink::Impl::left(const ConnectionPtr& c) { lose(c, HaplyProblem::closed, {}); }

void HaplyLink::Impl::lose(const ConnectionPtr& c, HaplyProblem why, const Failure& cause) {
  if (!is_ours(c)) return;
  now.reset();
  beast::get_lowest_layer(c->ws).close();
  handler.on_closed(why, cause ? cause.message() : std::string());
  if (stopping) return io.stop();
  later.expires_after(span_of(options.retry_s));
  later.async_wait([this](const Failure& failed) {
    if (!failed) connect();
  });
}

// --- The thread ----------------------------------------------------------------------------------------

void HaplyLink::Impl::look_around() {
  if (stopping) {
    if (!now) return io.stop();
    return leave(now);
  }
  if (!now) return;  // waits to connect again
  if (anew.exchange(false)) return leave(now);
  send_next(now);
}

void HaplyLink::Impl::listen_for_bell() {
  bell.async_read_some(asio::buffer(rings), [this](const Failure& failed, std::size_t) {
    if (failed) return;
    look_around();
    listen_for_bell();
  });
}

void HaplyLink::Impl::listen_for_turn() {
  turn.expires_after(kTurn);
  turn.async_wait([this](const Failure& failed) {
    if (failed) return;
    look_around();
    listen_for_turn();
  });
}

void HaplyLink::Impl::run() noexcept {
  pthread_setname_np(pthread_self(), options.thread);
  if (options.realtime) ask_for_realtime(kLinkPriority);  // refused: it runs with more jitter
  try {
    listen_for_bell();
    listen_for_turn();
    connect();
    io.run();
  } catch (const std::exception& broken) {  // no memory, no descriptors: the device is gone until it is opened again
    handler.on_closed(HaplyProblem::closed, broken.what());
  }
}

HaplyLink::HaplyLink(HaplyLinkHandler& handler)
    : bell_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)), impl_(std::make_unique<Impl>(handler)) {}

HaplyLink::~HaplyLink() {
  stop();
  if (bell_ >= 0) ::close(bell_);
}

Status HaplyLink::start(const HaplyLinkOptions& options) {
  if (impl_->thread.joinable()) return {};
  HaplyLinkHandler& handler = impl_->handler;
  impl_ = std::make_unique<Impl>(handler);
  impl_->options = options;
  const int fd = bell_ < 0 ? -1 : ::fcntl(bell_, F_DUPFD_CLOEXEC, 0);
  if (fd < 0)
    return fail("no event descriptor could be made", "Haply Inverse3", "close programs, or raise `ulimit -n`");
  impl_->bell.assign(fd);
  try {
    impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
  } catch (const std::system_error&) {
    return fail("no thread could be started", "Haply Inverse3", "end other programs, or raise the limit on threads");
  }
  return {};
}

void HaplyLink::stop() {
  if (!impl_->thread.joinable()) return;
  impl_->stopping = true;
  wake();
  impl_->thread.join();
}

void HaplyLink::wake() noexcept {
  const std::uint64_t one = 1;
  // Full, it rings anyway.
  [[maybe_unused]] const auto written = ::write(bell_, &one, sizeof one);
}

void HaplyLink::reconnect() noexcept {
  impl_->anew.store(true, std::memory_order_relaxed);
  wake();
}

}  // namespace tangent
