#include "core/planar/crossing.h"

#include "core/planar/polygon.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace tangent {
namespace {

/// In the order in which the sweep comes to them: as if the line leant a little, so that a vertical segment has ends
/// one after the other.
bool before(const Vec2& p, const Vec2& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; }

/// Positive: c is to the left of the way from a to b.
double side_of(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

/// Which side of a-b each end of c-d is on decides; ends on the line count as touching.
bool touch(const PlanarSegment& p, const PlanarSegment& q) {
  const auto apart = [](const PlanarSegment& s, const PlanarSegment& t) {
    const double c = side_of(s.a, s.b, t.a), d = side_of(s.a, s.b, t.b);
    return (c > 0.0 && d > 0.0) || (c < 0.0 && d < 0.0);
  };
  const Vec2 p_low = glm::min(p.a, p.b), p_high = glm::max(p.a, p.b), q_low = glm::min(q.a, q.b),
             q_high = glm::max(q.a, q.b);
  if (p_high.x < q_low.x || q_high.x < p_low.x || p_high.y < q_low.y || q_high.y < p_low.y) return false;
  return !apart(p, q) && !apart(q, p);
}

class Sweep {
 public:
  Sweep(std::span<const PlanarSegment> segments, bool closed)
      : segments_(segments.begin(), segments.end()),
        closed_(closed),
        line_(Below{this}),
        places_(segments.size(), line_.end()) {
    for (PlanarSegment& s : segments_)
      if (before(s.b, s.a)) std::swap(s.a, s.b);
  }

  std::optional<std::pair<std::size_t, std::size_t>> run() {
    // At one place beginnings come before ends.
    struct Event {
      Vec2 at;
      std::uint32_t segment;
      bool ends;
    };
    std::vector<Event> events;
    events.reserve(2 * segments_.size());
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
      events.push_back({segments_[i].a, i, false});
      events.push_back({segments_[i].b, i, true});
    }
    std::sort(events.begin(), events.end(), [](const Event& p, const Event& q) {
      if (p.at != q.at) return before(p.at, q.at);
      return p.ends != q.ends ? q.ends : p.segment < q.segment;
    });
    for (const Event& event : events)
      if (event.ends ? !end(event.segment) : !begin(event.segment)) return found_;
    return std::nullopt;
  }

 private:
  /// Order along the sweep's line, from below: of the one that began later, where it begins as seen from the other.
  struct Below {
    const Sweep* sweep;
    bool operator()(std::uint32_t i, std::uint32_t j) const { return i != j && sweep->is_below(i, j); }
  };
  using Line = std::set<std::uint32_t, Below>;

  bool is_below(std::uint32_t i, std::uint32_t j) const {
    const Vec2 &a = segments_[i].a, &b = segments_[j].a;
    const bool i_first = before(a, b) || (a == b && i < j);
    const PlanarSegment &early = segments_[i_first ? i : j], &late = segments_[i_first ? j : i];
    double side = side_of(early.a, early.b, late.a);
    if (side == 0.0) side = side_of(early.a, early.b, late.b);
    if (side == 0.0) return i < j;
    return (side > 0.0) == i_first;
  }

  bool begin(std::uint32_t i) {
    const Line::iterator here = line_.insert(i).first;
    places_[i] = here;
    if (here != line_.begin() && !compare(*std::prev(here), i)) return false;
    return std::next(here) == line_.end() || compare(i, *std::next(here));
  }

  bool end(std::uint32_t i) {
    const Line::iterator here = places_[i];
    const bool between = here != line_.begin() && std::next(here) != line_.end();
    const bool go_on = !between || compare(*std::prev(here), *std::next(here));
    line_.erase(here);
    return go_on;
  }

  /// False: they have a place in common.
  bool compare(std::uint32_t i, std::uint32_t j) {
    const std::size_t low = std::min(i, j), high = std::max(i, j);
    if (high - low == 1 || (closed_ && high - low == segments_.size() - 1)) return true;
    if (!touch(segments_[i], segments_[j])) return true;
    found_ = {low, high};
    return false;
  }

  std::vector<PlanarSegment> segments_;  ///< the sweep comes to a first
  bool closed_;
  Line line_;
  std::vector<Line::iterator> places_;
  std::pair<std::size_t, std::size_t> found_{};
};

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> find_crossing(std::span<const PlanarSegment> segments, bool closed) {
  return Sweep(segments, closed).run();
}

}  // namespace tangent
