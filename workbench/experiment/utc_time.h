// Dates of starts and ends, as BIDS and ISO 8601 write them: 2026-11-23T16:20:00Z.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tangent::experiment {

/// Seconds since 1970, UTC, by the system's clock.
std::int64_t utc_now_s();
std::string utc_text(std::int64_t utc_s);
/// None: it is no such text.
std::optional<std::int64_t> utc_of(const std::string& text);

}  // namespace tangent::experiment
