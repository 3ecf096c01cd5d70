// Replaces messages and link where Boost or nlohmann-json are missing: a device that says so.
#include "devices/haply/haply_codec.h"
#include "devices/haply/haply_link.h"

namespace tangent {

struct HaplyLink::Impl {};

bool haply_built_in() { return false; }
HaplyLink::HaplyLink(HaplyLinkHandler&) : bell_(-1) {}
HaplyLink::~HaplyLink() = default;
Status HaplyLink::start(const HaplyLinkOptions&) {
  return tl::unexpected(haply_error(HaplyProblem::not_built_in, "Haply Inverse3"));
}
void HaplyLink::stop() {}
void HaplyLink::wake() noexcept {}
void HaplyLink::reconnect() noexcept {}

bool read_haply(std::string_view, const std::vector<HaplyEntry>&, HaplyMessage&) { return false; }
bool read_haply_event(std::string_view, HaplyEvent&) { return false; }
bool is_haply_id(std::string_view) { return false; }
void write_haply_force(std::string&, std::string_view, const Vec3&, bool) {}

}  // namespace tangent
