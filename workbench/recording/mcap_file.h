// MCAP files (mcap.dev/spec, version 0): channels of messages with time, which Foxglove, Lichtblick and PlotJuggler
// open. Messages are JSON with a JSON schema; chunks are not compressed, and indexed.
#pragma once

#include "core/io/atomic_file.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

class McapFile {
 public:
  static Result<McapFile> create(const std::filesystem::path& path);

  /// `schema`: of its messages, JSON schema. Before the first message. Returns the channel's number.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name, const std::string& schema);
  Status write(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);
  /// Call once, last.
  Status commit();

 private:
  struct Channel {
    std::string schema_record, channel_record;
    std::uint64_t messages = 0;
    std::string index;  ///< of the open chunk: time and place of each message
  };
  struct Chunk {
    std::uint64_t first_ns = 0, last_ns = 0, at = 0, length = 0, index_length = 0, size = 0;
    std::map<std::uint16_t, std::uint64_t> index_at;
  };
  explicit McapFile(AtomicFile file) : file_(std::move(file)) {}
  Status put(std::string_view bytes);
  Status flush();
  std::string summary() const;

  AtomicFile file_;
  std::uint64_t at_ = 0;  ///< bytes in the file
  std::vector<Channel> channels_;
  std::vector<Chunk> chunks_;
  std::string open_;  ///< records of the open chunk
  std::uint64_t first_ns_ = 0, last_ns_ = 0;
  std::uint32_t sequence_ = 0;
};

}  // namespace tangent
