#include "tests/devices/usb/emulation/umockdev_node.h"

#include <umockdev.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <list>
#include <vector>

using tangent::emulation::UsbfsBoard;

namespace {

/// A URB of the client: its memory there, and our copy, which the board works on.
struct RemoteUrb {
  UMockdevIoctlData* urb = nullptr;
  UMockdevIoctlData* buffer = nullptr;
  std::vector<unsigned char> bytes;
  alignas(usbdevfs_urb)
      std::array<unsigned char, sizeof(usbdevfs_urb)> memory{};  // ends in a flexible array: no member by itself

  usbdevfs_urb& local() { return *reinterpret_cast<usbdevfs_urb*>(memory.data()); }
};

struct NodeState {
  UsbfsBoard* board = nullptr;
  std::list<RemoteUrb> urbs;  // addresses stay
};

unsigned long pointer_in(UMockdevIoctlData* data) {
  unsigned long value = 0;
  std::memcpy(&value, data->data, sizeof value);
  return value;
}

void write_back(UMockdevIoctlData* to, std::size_t offset, const void* from, std::size_t size) {
  std::vector<guint8> bytes(size);
  std::memcpy(bytes.data(), from, size);
  umockdev_ioctl_data_update(to, offset, bytes.data(), static_cast<gint>(size));
}

void forget(NodeState& state, std::list<RemoteUrb>::iterator urb) {
  umockdev_ioctl_data_unref(urb->urb);
  if (urb->buffer != nullptr) umockdev_ioctl_data_unref(urb->buffer);
  state.urbs.erase(urb);
}

int submit(NodeState& state, UMockdevIoctlData* argument) {
  RemoteUrb& r = state.urbs.emplace_back();
  r.urb = umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr);
  std::memcpy(r.memory.data(), r.urb->data, sizeof(usbdevfs_urb));
  const auto size = static_cast<std::size_t>(r.local().buffer_length);
  r.bytes.resize(std::max<std::size_t>(size, 8));
  if (size > 0) {
    r.buffer = umockdev_ioctl_data_resolve(r.urb, offsetof(usbdevfs_urb, buffer), size, nullptr);
    std::memcpy(r.bytes.data(), r.buffer->data, size);
  }
  r.local().buffer = r.bytes.data();
  const int code = state.board->ioctl(USBDEVFS_SUBMITURB, &r.local());
  if (code < 0) forget(state, std::prev(state.urbs.end()));
  return code;
}

int discard(NodeState& state, UMockdevIoctlData* argument) {
  const unsigned long address = pointer_in(argument);
  const auto found = std::find_if(state.urbs.begin(), state.urbs.end(),
                                  [&](const RemoteUrb& r) { return r.urb->client_addr == address; });
  return found == state.urbs.end() ? -EINVAL : state.board->ioctl(USBDEVFS_DISCARDURB, &found->local());
}

int reap(NodeState& state, UMockdevIoctlData* argument) {
  void* done = nullptr;
  const int code = state.board->ioctl(USBDEVFS_REAPURBNDELAY, static_cast<void*>(&done));
  if (code < 0) return code;
  const auto r = std::find_if(state.urbs.begin(), state.urbs.end(),
                              [&](RemoteUrb& u) { return static_cast<void*>(&u.local()) == done; });
  if (r->buffer != nullptr)
    write_back(r->buffer, 0, r->bytes.data(), static_cast<std::size_t>(r->local().buffer_length));
  write_back(r->urb, offsetof(usbdevfs_urb, status), &r->local().status, sizeof(int));
  write_back(r->urb, offsetof(usbdevfs_urb, actual_length), &r->local().actual_length, sizeof(int));
  UMockdevIoctlData* out = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
  umockdev_ioctl_data_set_ptr(out, 0, r->urb);
  umockdev_ioctl_data_unref(out);
  forget(state, r);
  return 0;
}

int answer(NodeState& state, gulong request, UMockdevIoctlData* argument) {
  switch (request) {
    case USBDEVFS_SUBMITURB:
      return submit(state, argument);
    case USBDEVFS_DISCARDURB:
      return discard(state, argument);
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      return reap(state, argument);
    case USBDEVFS_GET_CAPABILITIES: {
      std::uint32_t capabilities = 0;
      const int code = state.board->ioctl(request, &capabilities);
      UMockdevIoctlData* out = umockdev_ioctl_data_resolve(argument, 0, sizeof capabilities, nullptr);
      write_back(out, 0, &capabilities, sizeof capabilities);
      umockdev_ioctl_data_unref(out);
      return code;
    }
    default:
      return state.board->ioctl(request, nullptr);  // none of these look at their argument
  }
}

// GObject's way of a derived class.
struct TangentNodeClass {
  UMockdevIoctlBaseClass parent;
};
struct TangentNode {
  UMockdevIoctlBase parent;
  NodeState* state;
};

gboolean handle(UMockdevIoctlBase* self, UMockdevIoctlClient* client) {
  NodeState& state = *reinterpret_cast<TangentNode*>(self)->state;
  const int code = answer(state, umockdev_ioctl_client_get_request(client), umockdev_ioctl_client_get_arg(client));
  umockdev_ioctl_client_complete(client, code < 0 ? -1 : code, code < 0 ? -code : 0);
  return TRUE;
}

void finalize(GObject* object);

void init_class(gpointer type, gpointer) {
  static_cast<TangentNodeClass*>(type)->parent.handle_ioctl = &handle;
  G_OBJECT_CLASS(type)->finalize = &finalize;
}

GType node_type() {
  static const GType type =
      g_type_register_static_simple(UMOCKDEV_TYPE_IOCTL_BASE, "TangentNode", sizeof(TangentNodeClass), &init_class,
                                    sizeof(TangentNode), nullptr, GTypeFlags(0));
  return type;
}

void finalize(GObject* object) {
  delete reinterpret_cast<TangentNode*>(object)->state;
  G_OBJECT_CLASS(g_type_class_peek_parent(g_type_class_peek(node_type())))->finalize(object);
}

}  // namespace

namespace tangent::emulation {

UmockdevNode::UmockdevNode(UMockdevTestbed* testbed, const std::string& path, UsbfsBoard& board)
    : testbed_(testbed), path_(path) {
  auto* node = static_cast<TangentNode*>(g_object_new(node_type(), nullptr));
  node->state = new NodeState{&board, {}};
  GError* error = nullptr;
  if (!umockdev_testbed_attach_ioctl(testbed_, path_.c_str(), &node->parent, &error)) {
    std::fprintf(stderr, "umockdev: %s\n", error->message);
    std::abort();
  }
  g_object_unref(node);
}

UmockdevNode::~UmockdevNode() { umockdev_testbed_detach_ioctl(testbed_, path_.c_str(), nullptr); }

}  // namespace tangent::emulation
