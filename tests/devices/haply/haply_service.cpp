#include "tests/devices/haply/haply_service.h"

#include "devices/base/realtime_thread.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

#include <deque>
#include <future>
#include <mutex>
#include <thread>

namespace tangent::testing {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using asio::ip::tcp;
using Failed = boost::system::error_code;
using nlohmann::json;

json vector_json(const Vec3& v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }

struct Client {
  explicit Client(tcp::socket socket) : ws(std::move(socket)) {}
  websocket::stream<beast::tcp_stream> ws;
  beast::flat_buffer heard;
  std::deque<std::string> to_send;
  bool sends = false, gone = false;
};
using ClientPtr = std::shared_ptr<Client>;

}  // namespace

struct HaplyService::Impl {
  HaplyServiceOptions options;
  asio::io_context io{1};
  asio::executor_work_guard<asio::io_context::executor_type> busy{io.get_executor()};
  tcp::acceptor keeper{io}, acceptor{io};
  tcp::endpoint here{asio::ip::make_address("127.0.0.1"), 0};
  std::vector<ClientPtr> clients;
  std::thread thread;

  // The service's thread writes, any reads.
  mutable std::mutex mutex;
  std::uint64_t received = 0, forces = 0;
  Vec3 force_n{0.0}, finger_m{0.0, -0.12, 0.15}, velocity{0.0};
  std::deque<std::string> asked;
  bool polite = false;

  Policy policy;
  std::vector<std::pair<ClientPtr, std::string>> held;

  void take_port();
  void listen();
  void accept();
  void greet(const ClientPtr& c);
  void read(const ClientPtr& c);
  void take(const std::string& text);
  std::string state(bool whole) const;
  void reply(const ClientPtr& c, std::uint64_t n, const std::string& right);
  void send(const ClientPtr& c, std::string text);
  void write(const ClientPtr& c);
  void reset(const ClientPtr& c);
  void send_half(const ClientPtr& c);

  template <class F>
  void in_thread(F what) {
    std::promise<void> done;
    asio::post(io, [&] {
      what();
      done.set_value();
    });
    done.get_future().wait();
  }
};

/// A port of its own, which `keeper` holds without listening: while the service is away nobody else is given it.
void HaplyService::Impl::take_port() {
  keeper.open(here.protocol());
  keeper.set_option(tcp::acceptor::reuse_address(true));
  keeper.bind(here);
  here = keeper.local_endpoint();
}

void HaplyService::Impl::listen() {
  acceptor.open(here.protocol());
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  acceptor.bind(here);
  acceptor.listen();
  accept();
}

void HaplyService::Impl::accept() {
  acceptor.async_accept([this](const Failed& failed, tcp::socket socket) {
    if (failed) return;
    socket.set_option(tcp::no_delay(true));
    const auto client = std::make_shared<Client>(std::move(socket));
    clients.push_back(client);
    client->ws.async_accept([this, client](const Failed& refused) {
      if (!refused && !client->gone) greet(client);
    });
    accept();
  });
}

void HaplyService::Impl::greet(const ClientPtr& c) {
  c->ws.text(true);
  reply(c, 0, state(true));
  read(c);
}

void HaplyService::Impl::read(const ClientPtr& c) {
  c->ws.async_read(c->heard, [this, c](const Failed& failed, std::size_t) {
    if (failed) {
      c->gone = true;
      const std::lock_guard lock(mutex);
      polite = failed == websocket::error::closed;
      return;
    }
    const std::string text = beast::buffers_to_string(c->heard.data());
    c->heard.consume(c->heard.size());
    take(text);
    reply(c, received, state(text.find("force_render_full_state") != std::string::npos));
    if (!c->gone) read(c);
  });
}

void HaplyService::Impl::take(const std::string& text) {
  const std::lock_guard lock(mutex);
  ++received;
  asked.push_back(text);
  if (asked.size() > 10) asked.pop_front();
  const json message = json::parse(text);
  if (!message.contains("inverse3")) return;
  const json& command = message["inverse3"][0]["commands"]["set_cursor_force"];
  const json& force = command.at(options.old_format ? "values" : "vector");
  force_n = Vec3(force["x"], force["y"], force["z"]);
  ++forces;
  if (options.mass_kg <= 0.0) return;
  velocity += force_n * (1e-3 / options.mass_kg);  // a message a millisecond
  finger_m += velocity * 1e-3;
}

std::string HaplyService::Impl::state(bool whole) const {
  json message;
  if (whole && !options.old_format) message["session_id"] = 7;
  message["inverse3"] = json::array();
  for (const std::string& id : options.devices) {
    json device{{"device_id", id},
                {"state",
                 {{"cursor_position", vector_json(finger_m)},
                  {"cursor_velocity", vector_json(velocity)},
                  {"control_mode", "idle"},
                  {"transform",
                   {{"position", vector_json(Vec3(0.0))},
                    {"rotation", {{"w", 1}, {"x", 0}, {"y", 0}, {"z", 0}}},
                    {"scale", vector_json(Vec3(1.0))}}}}},
                {"status",
                 {{"calibrated", options.calibrated},
                  {"in_use", options.in_use},
                  {"power_supply", options.power},
                  {"ready", true},
                  {"started", true}}}};
    if (whole) device["config"] = {{"type", "inverse3"}, {"basis", {{"permutation", options.permutation}}}};
    message["inverse3"].push_back(device);
  }
  if (!options.grip) return message.dump();
  const Quat& q = *options.grip;
  message["wireless_verse_grip"] = {{{"device_id", "61548"},
                                     {"state",
                                      {{"buttons", {{"a", true}, {"b", false}, {"c", false}}},
                                       {"orientation", {{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}}}}}}};
  return message.dump();
}

void HaplyService::Impl::reply(const ClientPtr& c, std::uint64_t n, const std::string& right) {
  const HaplyReply reply = policy ? policy(n, right) : HaplyReply{HaplyReply::How::send, right};
  switch (reply.how) {
    case HaplyReply::How::send:
      return send(c, reply.text);
    case HaplyReply::How::hold:
      return held.emplace_back(c, reply.text), void();
    case HaplyReply::How::close:
      return c->ws.async_close(websocket::close_code::going_away, [c](const Failed&) {});
    case HaplyReply::How::reset:
      return reset(c);
    case HaplyReply::How::half_frame:
      return send_half(c);
    case HaplyReply::How::flood:
      for (int i = 0; i < 300; ++i) send(c, reply.text);
      return;
    case HaplyReply::How::nothing:
      return;
  }
}

void HaplyService::Impl::send(const ClientPtr& c, std::string text) {
  c->to_send.push_back(std::move(text));
  if (!c->sends) write(c);
}

void HaplyService::Impl::write(const ClientPtr& c) {
  c->sends = true;
  c->ws.async_write(asio::buffer(c->to_send.front()), [this, c](const Failed& failed, std::size_t) {
    c->sends = false;
    if (failed || c->gone) return;
    c->to_send.pop_front();
    if (!c->to_send.empty()) write(c);
  });
}

void HaplyService::Impl::reset(const ClientPtr& c) {
  if (std::exchange(c->gone, true)) return;
  tcp::socket& socket = beast::get_lowest_layer(c->ws).socket();
  Failed ignored;
  socket.set_option(asio::socket_base::linger(true, 0), ignored);
  socket.close(ignored);
}

/// The first bytes of a text of 200, and no more of it: past Beast, which may still be writing.
void HaplyService::Impl::send_half(const ClientPtr& c) {
  std::string bytes("\x81\x7e");
  bytes.append({'\0', static_cast<char>(200)}).append("{\"inverse3\":[");
  Failed ignored;
  asio::write(beast::get_lowest_layer(c->ws).socket(), asio::buffer(bytes), ignored);
}

HaplyService::HaplyService(HaplyServiceOptions options) : impl_(std::make_unique<Impl>()) {
  impl_->options = std::move(options);
  impl_->take_port();
  impl_->listen();
  impl_->thread = std::thread([impl = impl_.get()] {
    if (impl->options.realtime) ask_for_realtime(kLinkPriority);
    impl->io.run();
  });
}

HaplyService::~HaplyService() {
  go_away();
  impl_->io.stop();
  impl_->thread.join();
}

std::string HaplyService::address() const { return "ws://127.0.0.1:" + std::to_string(impl_->here.port()); }

void HaplyService::set_policy(Policy policy) {
  impl_->in_thread([&] { impl_->policy = std::move(policy); });
}

void HaplyService::set_options(const HaplyServiceOptions& options) {
  impl_->in_thread([&] { impl_->options = options; });
}

void HaplyService::put_finger(const Vec3& position_m) {
  impl_->in_thread([&] {
    const std::lock_guard lock(impl_->mutex);
    impl_->finger_m = position_m;
  });
}

void HaplyService::push(const std::string& text) {
  impl_->in_thread([&] {
    for (const ClientPtr& client : impl_->clients)
      if (!client->gone) impl_->send(client, text);
  });
}

void HaplyService::release_held() {
  impl_->in_thread([&] {
    for (auto& [client, text] : std::exchange(impl_->held, {})) {
      if (!client->gone) impl_->send(client, std::move(text));
    }
  });
}

void HaplyService::drop() {
  impl_->in_thread([&] {
    for (const ClientPtr& client : std::exchange(impl_->clients, {})) impl_->reset(client);
    impl_->held.clear();
  });
}

void HaplyService::go_away() {
  impl_->in_thread([&] {
    Failed ignored;
    impl_->acceptor.close(ignored);
  });
  drop();
}

void HaplyService::come_back() {
  impl_->in_thread([&] { impl_->listen(); });
}

std::uint64_t HaplyService::received() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->received;
}

std::uint64_t HaplyService::forces() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->forces;
}

Vec3 HaplyService::force_n() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->force_n;
}

Vec3 HaplyService::finger_m() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->finger_m;
}

std::vector<std::string> HaplyService::asked() const {
  const std::lock_guard lock(impl_->mutex);
  return {impl_->asked.begin(), impl_->asked.end()};
}

bool HaplyService::closed_politely() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->polite;
}

}  // namespace tangent::testing
