#include "workbench/recording/tick_reader.h"

#include "workbench/recording/byte_stream.h"

#include <bit>

namespace tangent {
namespace {

tl::unexpected<Error> bad_tick(std::uint64_t tick, std::string_view column, const std::string& what) {
  return fail(what, "tick " + std::to_string(tick) + ", column " + std::string(column),
              "the file is damaged: copy it from where it was recorded again");
}

}  // namespace

Status TickReader::read_devices(std::uint64_t tick) {
  const auto advance = [this]() -> Status {
    next_tick_.reset();
    const Result<bool> row = devices_.step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
    const auto at = static_cast<std::uint64_t>(devices_.whole(0));
    for (std::size_t i = 0; i < device_columns().size(); ++i) {
      const WholeColumn& column = device_columns()[i];
      const int place = static_cast<int>(i) + 1;
      next_[i] = devices_.is_null(place) ? 0 : devices_.whole(place);
      if (next_[i] < column.least || next_[i] > column.most)
        return bad_tick(at, column.name, std::to_string(next_[i]) + " is out of range");
    }
    next_tick_ = at;
    return {};
  };
  if (!began_)
    if (Status ok = advance(); !ok) return ok;
  began_ = true;
  while (next_tick_ && *next_tick_ <= tick) {
    now_ = next_;
    if (Status ok = advance(); !ok) return ok;
  }
  return {};
}

Status TickReader::read_odd(std::uint64_t tick, int column) {
  odd_mask_ = 0;
  ByteReader bytes(ticks_.bytes(column));
  while (!bytes.done()) {
    std::uint8_t which = 0;
    double value = 0.0;
    bytes.all(which, value);
    if (!bytes.good() || which >= real_columns().size()) return bad_tick(tick, "odd_bits", "is damaged");
    odd_mask_ |= std::uint64_t{1} << which;
    odd_[which] = value;
  }
  return {};
}

Status TickReader::read_reals(RecordedTick& tick, int column) {
  const std::uint64_t number = tick.record.tick.tick;
  if (Status ok = read_odd(number, column + static_cast<int>(real_columns().size()) + 1); !ok) return ok;
  tick.has_velocity = false;
  for (std::size_t i = 0; i < real_columns().size(); ++i, ++column) {
    const RealColumn& real = real_columns()[i];
    double& to = real.at(tick);
    const bool odd = ((odd_mask_ >> i) & 1u) != 0, absent = ticks_.is_null(column);
    if (odd)
      to = odd_[i];
    else if (!absent && !ticks_.is_number(column))
      return bad_tick(number, real.name, "is not a number");
    else if (!absent)
      to = ticks_.real(column);
    else if (real.same_as != nullptr)
      to = real.same_as(tick);
    else if (real.of_velocity || ((default_mask_ >> i) & 1u) != 0)
      to = 0.0;
    else
      return bad_tick(number, real.name, "is missing");
    tick.has_velocity = tick.has_velocity || (real.of_velocity && (odd || !absent));
  }
  return {};
}

Status TickReader::read_row(RecordedTick& tick) {
  int column = 0;
  tick.record.tick.tick = static_cast<std::uint64_t>(ticks_.whole(column++));
  for (const WholeColumn& whole : whole_columns()) {
    const int at = column++;
    const bool absent = ticks_.is_null(at);
    if (!absent && !ticks_.is_whole(at)) return bad_tick(tick.record.tick.tick, whole.name, "is not a whole number");
    const std::int64_t value = absent ? 0 : ticks_.whole(at);
    if (value < whole.least || value > whole.most)
      return bad_tick(tick.record.tick.tick, whole.name, std::to_string(value) + " is out of range");
    whole.set(tick, value);
  }
  if (Status ok = read_reals(tick, column); !ok) return ok;
  tick.digest = std::bit_cast<std::uint64_t>(ticks_.whole(column + static_cast<int>(real_columns().size())));
  tick.record.tick.input.velocity = tick.has_velocity ? std::optional(tick.velocity) : std::nullopt;
  if (Status ok = read_devices(tick.record.tick.tick); !ok) return ok;
  for (std::size_t i = 0; i < device_columns().size(); ++i) device_columns()[i].set(tick, now_[i]);
  return {};
}

Result<bool> TickReader::next(RecordedTick& tick) {
  const Result<bool> row = ticks_.step();
  if (!row) return row;
  if (!*row) return false;
  if (Status ok = read_row(tick); !ok) return tl::unexpected(ok.error());
  return true;
}

}  // namespace tangent
