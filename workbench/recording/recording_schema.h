// Tables of a recording. workbench/recording/README.md documents them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tangent {

/// PRAGMA user_version. A newer one is refused; what an older one lacks has the defaults.
inline constexpr std::int64_t kRecordingFormat = 1;
/// PRAGMA application_id, "TgWb".
inline constexpr std::int64_t kRecordingId = 0x54675762;

/// Tables, the view `ticks`, and the meaning of columns. Statements, to run in one transaction.
std::string recording_schema();

/// A part of the bytes of a scene.
inline constexpr std::size_t kScenePart = std::size_t{16} << 20;

std::string insert_tick_sql();
std::string insert_device_sql();
std::string insert_overview_sql();

}  // namespace tangent
