#include "workbench/recording/mcap_file.h"

#include <algorithm>
#include <bit>

namespace tangent {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::size_t kChunk = std::size_t{1} << 20;

enum class Op : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  statistics = 0x0b,
  data_end = 0x0f
};

/// Integers of their own width, texts with their length before them.
template <class T>
void put_number(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void put_text(std::string& out, std::string_view text) {
  put_number(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}
std::string record(Op op, std::string_view content) {
  std::string out;
  put_number(out, static_cast<std::uint8_t>(op));
  put_number(out, static_cast<std::uint64_t>(content.size()));
  out += content;
  return out;
}

}  // namespace

Result<McapFile> McapFile::create(const std::filesystem::path& path) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  McapFile mcap(std::move(*file));
  std::string header;
  put_text(header, "");
  put_text(header, "tangent-workbench " TANGENT_VERSION);
  if (Status ok = mcap.put(std::string(kMagic) + record(Op::header, header)); !ok) return tl::unexpected(ok.error());
  return mcap;
}

Status McapFile::put(std::string_view bytes) {
  at_ += bytes.size();
  return file_.write(bytes);
}

std::uint16_t McapFile::add_channel(const std::string& topic, const std::string& schema_name,
                                    const std::string& schema) {
  const auto number = static_cast<std::uint16_t>(channels_.size() + 1);  // 0 is no schema
  std::string described, channel;
  put_number(described, number);
  put_text(described, schema_name);
  put_text(described, "jsonschema");
  put_text(described, schema);
  put_number(channel, number);
  put_number(channel, number);
  put_text(channel, topic);
  put_text(channel, "json");
  put_number(channel, std::uint32_t{0});
  channels_.push_back({record(Op::schema, described), record(Op::channel, channel), 0, {}});
  open_ += channels_.back().schema_record + channels_.back().channel_record;
  return number;
}

Status McapFile::write(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  Channel& to = channels_[channel - 1u];
  const bool first = std::all_of(channels_.begin(), channels_.end(), [](const Channel& c) { return c.index.empty(); });
  first_ns_ = first ? time_ns : std::min(first_ns_, time_ns);
  last_ns_ = first ? time_ns : std::max(last_ns_, time_ns);
  put_number(to.index, time_ns);
  put_number(to.index, static_cast<std::uint64_t>(open_.size()));
  ++to.messages;
  put_number(open_, static_cast<std::uint8_t>(Op::message));
  put_number(open_, static_cast<std::uint64_t>(22 + json.size()));
  put_number(open_, channel);
  put_number(open_, sequence_++);
  put_number(open_, time_ns);
  put_number(open_, time_ns);
  open_ += json;
  return open_.size() < kChunk ? Status{} : flush();
}

Status McapFile::flush() {
  if (open_.empty()) return {};
  std::string content;
  put_number(content, first_ns_);
  put_number(content, last_ns_);
  put_number(content, static_cast<std::uint64_t>(open_.size()));
  put_number(content, std::uint32_t{0});  // no checksum
  put_text(content, "");                  // not compressed
  put_number(content, static_cast<std::uint64_t>(open_.size()));
  content += open_;
  const std::string chunk = record(Op::chunk, content);
  Chunk entry{first_ns_, last_ns_, at_, chunk.size(), 0, open_.size(), {}};
  if (Status ok = put(chunk); !ok) return ok;
  const std::uint64_t index_begin = at_;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].index.empty()) continue;
    const auto number = static_cast<std::uint16_t>(i + 1);
    std::string index;
    put_number(index, number);
    put_text(index, channels_[i].index);
    channels_[i].index.clear();
    entry.index_at[number] = at_;
    if (Status ok = put(record(Op::message_index, index)); !ok) return ok;
  }
  entry.index_length = at_ - index_begin;
  chunks_.push_back(std::move(entry));
  open_.clear();
  return {};
}

std::string McapFile::summary() const {
  std::string out, statistics, counts;
  for (const Channel& channel : channels_) out += channel.schema_record + channel.channel_record;
  std::uint64_t messages = 0, first = chunks_.empty() ? 0 : chunks_.front().first_ns, last = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    messages += channels_[i].messages;
    put_number(counts, static_cast<std::uint16_t>(i + 1));
    put_number(counts, channels_[i].messages);
  }
  for (const Chunk& chunk : chunks_) {
    first = std::min(first, chunk.first_ns);
    last = std::max(last, chunk.last_ns);
    std::string places, index;
    for (const auto& [channel, at] : chunk.index_at) {
      put_number(places, channel);
      put_number(places, at);
    }
    for (const std::uint64_t value : {chunk.first_ns, chunk.last_ns, chunk.at, chunk.length}) put_number(index, value);
    put_text(index, places);
    put_number(index, chunk.index_length);
    put_text(index, "");
    put_number(index, chunk.size);
    put_number(index, chunk.size);
    out += record(Op::chunk_index, index);
  }
  put_number(statistics, messages);
  put_number(statistics, static_cast<std::uint16_t>(channels_.size()));
  put_number(statistics, static_cast<std::uint32_t>(channels_.size()));
  put_number(statistics, std::uint64_t{0});  // attachments and metadata
  put_number(statistics, static_cast<std::uint32_t>(chunks_.size()));
  put_number(statistics, first);
  put_number(statistics, last);
  put_text(statistics, counts);
  return out + record(Op::statistics, statistics);
}

Status McapFile::commit() {
  if (Status ok = flush(); !ok) return ok;
  std::string end, footer;
  put_number(end, std::uint32_t{0});
  if (Status ok = put(record(Op::data_end, end)); !ok) return ok;
  put_number(footer, at_);
  put_number(footer, std::uint64_t{0});  // no offsets of the summary's groups
  put_number(footer, std::uint32_t{0});
  if (Status ok = put(summary() + record(Op::footer, footer) + std::string(kMagic)); !ok) return ok;
  return file_.commit();
}

}  // namespace tangent
