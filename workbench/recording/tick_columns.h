// The columns of a recorded tick: one table that schema, writer, reader, replay, export and page share.
#pragma once

#include "workbench/session/servo_record.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

/// A tick as a file holds it. `record.tick.kept` is not part of its row.
struct RecordedTick {
  ServoRecord record;
  /// record.tick.input.velocity, where has_velocity.
  Vec3 velocity{0.0};
  bool has_velocity = false;
  std::uint64_t digest = 0;  ///< output_digest of the output as it was computed
};
RecordedTick recorded_tick(const ServoRecord& record);

/// Who a column belongs to.
enum class ColumnOf : std::uint8_t { input, output, timing, device };

/// A double. Where it has the bits of another column (`same_as`), the file holds NULL.
struct RealColumn {
  std::string_view name;  ///< with its unit
  ColumnOf of = ColumnOf::input;
  std::string_view meaning;
  double& (*at)(RecordedTick&) = nullptr;
  double& (*same_as)(RecordedTick&) = nullptr;  ///< null: none
  std::string_view same_name = {};
  bool of_velocity = false;  ///< NULL where there is none
};

/// A whole number, or the code of a word.
struct WholeColumn {
  std::string_view name;
  ColumnOf of = ColumnOf::output;
  std::string_view meaning;
  std::int64_t least = 0, most = 0;  ///< what a file may hold
  std::int64_t (*get)(const RecordedTick&) = nullptr;
  void (*set)(RecordedTick&, std::int64_t) = nullptr;
  const char* (*word)(std::int64_t) = nullptr;  ///< null: a number
};

std::span<const RealColumn> real_columns();
/// Of every tick.
std::span<const WholeColumn> whole_columns();
/// States of devices and gate, which seldom change: a row of their own whenever one does.
std::span<const WholeColumn> device_columns();

/// "m", "N", "m/s", "ns": the unit that ends a column's name; "1" without one.
std::string unit_of(std::string_view column);

/// 64 bits of everything in it, the sign of zeros included.
std::uint64_t output_digest(const TickOutput& output);

}  // namespace tangent
