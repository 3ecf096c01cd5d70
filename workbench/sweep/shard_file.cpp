#include "workbench/sweep/shard_file.h"

#include "core/base/fnv.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

namespace tangent::sweep {
namespace {

using nlohmann::ordered_json;

constexpr int kShardFormat = 2;  // 2: counted times, and times
constexpr std::size_t kDigits = 16;

std::string checksum(std::string_view text) { return Fnv().add(text).text(); }

std::string line_of(const ordered_json& json) {
  const std::string text = json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  return checksum(text) + " " + text + "\n";
}

/// What a line says; empty: it is torn or damaged.
std::optional<ordered_json> read_line(std::string_view line) {
  if (line.size() < kDigits + 2 || line[kDigits] != ' ') return std::nullopt;
  const std::string_view text = line.substr(kDigits + 1);
  if (line.substr(0, kDigits) != checksum(text)) return std::nullopt;
  ordered_json json = ordered_json::parse(text, nullptr, false);
  return json.is_object() ? std::optional(std::move(json)) : std::nullopt;
}

ordered_json name_json(const ShardName& name) {
  return {{"format", kShardFormat}, {"plan", name.plan},   {"shard", name.shard},
          {"shards", name.shards},  {"first", name.first}, {"end", name.end}};
}

ordered_json result_json(const CellResult& result) {
  ordered_json json{{"cell", result.cell}};
  if (!result.failed.empty()) {
    json["failed"] = result.failed;
    return json;
  }
  for (const NumberColumn& column : number_columns())
    std::visit([&](auto field) { json[std::string(column.name)] = result.numbers.*field; }, column.field);
  return json;
}

bool take_number(const ordered_json& json, const NumberColumn& column, CellNumbers& numbers) {
  const auto at = json.find(std::string(column.name));
  if (at == json.end()) return false;
  if (const auto* whole = std::get_if<std::uint64_t CellNumbers::*>(&column.field)) {
    if (!at->is_number_unsigned()) return false;
    numbers.*(*whole) = at->get<std::uint64_t>();
    return true;
  }
  if (!at->is_number()) return false;
  numbers.*(std::get<double CellNumbers::*>(column.field)) = at->get<double>();
  return true;
}

bool take_result(const ordered_json& json, const ShardName& name, CellResult& result) {
  const auto cell = json.find("cell");
  if (cell == json.end() || !cell->is_number_unsigned()) return false;
  result = {cell->get<std::uint64_t>(), {}, {}};
  if (result.cell < name.first || result.cell >= name.end) return false;
  if (const auto failed = json.find("failed"); failed != json.end()) {
    if (!failed->is_string()) return false;
    result.failed = failed->get<std::string>();
    return !result.failed.empty();
  }
  for (const NumberColumn& column : number_columns())
    if (!take_number(json, column, result.numbers)) return false;
  return true;
}

constexpr std::array kTimeNumbers{std::pair{"ns", &PairedTime::ns}, std::pair{"against_ns", &PairedTime::against_ns},
                                  std::pair{"ratio", &PairedTime::ratio}, std::pair{"low", &PairedTime::low},
                                  std::pair{"high", &PairedTime::high}};

ordered_json time_json(const CellTime& time) {
  ordered_json json{{"time_of", time.cell}, {"against", time.against}};
  for (const auto& [name, field] : kTimeNumbers) json[name] = time.time.*field;
  json["verdict"] = kVerdictNames[static_cast<std::size_t>(time.time.verdict)];
  json["rounds"] = time.time.rounds;
  if (time.time.instructions) json["instructions"] = *time.time.instructions;
  json["machine"] = time.machine;
  return json;
}

bool take_time(const ordered_json& json, const ShardName& name, CellTime& out) {
  const auto whole = [&](const char* key, std::uint64_t& value) {
    const auto at = json.find(key);
    if (at == json.end() || !at->is_number_unsigned()) return false;
    value = at->get<std::uint64_t>();
    return true;
  };
  out = {};
  if (!whole("time_of", out.cell) || !whole("against", out.against) || !whole("rounds", out.time.rounds)) return false;
  if (out.cell < name.first || out.cell >= name.end) return false;
  for (const auto& [key, field] : kTimeNumbers) {
    const auto at = json.find(key);
    if (at == json.end() || !at->is_number()) return false;
    out.time.*field = at->get<double>();
  }
  const auto verdict = json.find("verdict"), machine = json.find("machine");
  if (verdict == json.end() || !verdict->is_string() || machine == json.end() || !machine->is_string()) return false;
  const auto* const known = std::find(kVerdictNames.begin(), kVerdictNames.end(), verdict->get<std::string>());
  if (known == kVerdictNames.end()) return false;
  out.time.verdict = static_cast<TimeVerdict>(known - kVerdictNames.begin());
  out.machine = machine->get<std::string>();
  if (const auto counted = json.find("instructions"); counted != json.end() && counted->is_number())
    out.time.instructions = counted->get<double>();
  return true;
}

/// A line after the first.
bool take_line(const ordered_json& json, const ShardName& name, ShardLine& line) {
  if (json.contains("time_of")) return take_time(json, name, line.emplace<CellTime>());
  return take_result(json, name, line.emplace<CellResult>());
}

std::string shard_text(const ShardName& name) {
  return "shard " + std::to_string(name.shard) + " of " + std::to_string(name.shards);
}

/// Of the first line, which is whole.
Status check_name(const ordered_json& json, const ShardName& name, const std::filesystem::path& path) {
  const auto format = json.find("format");
  if (format == json.end() || !format->is_number_integer())
    return fail("is no shard of a sweep", path.string(), "remove it, and run that shard again");
  if (*format != kShardFormat)
    return fail(*format < kShardFormat ? "is of an older program" : "is of a newer program", path.string(),
                "read it with that program, or run that shard again");
  if (json == name_json(name)) return {};
  return fail("belongs to another plan or shard (wanted: " + shard_text(name) + " of plan " + name.plan + ")",
              path.string(), "remove it, and run that shard again");
}

/// Before its end: nothing goes on from there.
Status damaged(const std::filesystem::path& path, std::uint64_t line, const ShardName& name) {
  return fail("line " + std::to_string(line) + " is damaged", path.string(),
              "remove it, and run " + shard_text(name) + " again");
}

Status torn(const std::filesystem::path& path, std::uint64_t line, const ShardName& name) {
  return fail("line " + std::to_string(line) + " is torn or damaged", path.string(),
              "run " + shard_text(name) + " again: it goes on from what is whole");
}

std::string reason() { return std::strerror(errno); }

}  // namespace

ShardName shard_of(const std::string& plan, std::uint64_t cells, std::uint64_t shard, std::uint64_t shards) {
  const std::uint64_t each = cells / shards, more = cells % shards;  // the first `more` have one more
  const std::uint64_t first = shard * each + std::min(shard, more);
  return {plan, shard, shards, first, first + each + (shard < more ? 1 : 0)};
}

// --- Writing ---------------------------------------------------------------------------------------------

ShardWriter::ShardWriter(ShardWriter&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      done_(std::move(other.done_)),
      timed_(std::move(other.timed_)),
      failures_(std::move(other.failures_)) {}

ShardWriter::~ShardWriter() {
  if (file_ >= 0) ::close(file_);
}

namespace {

/// What of the file is whole, and the cells in it.
struct Whole {
  std::uint64_t bytes = 0;
  bool named = false;
};

Result<Whole> look_through(const std::filesystem::path& path, const ShardName& name, std::vector<bool>& done,
                           std::vector<bool>& timed, Failures& failures) {
  std::ifstream file(path, std::ios::binary);
  Whole whole;
  std::string line;
  ShardLine taken;
  for (std::uint64_t number = 1; std::getline(file, line); ++number) {
    if (file.eof()) break;  // no line end: it was being written
    const auto json = read_line(line);
    const bool last = file.peek() == std::ifstream::traits_type::eof();
    if (!json) {
      if (last) break;
      return tl::unexpected(damaged(path, number, name).error());
    }
    if (!whole.named) {
      if (Status ok = check_name(*json, name, path); !ok) return tl::unexpected(ok.error());
      whole.named = true;
    } else if (take_line(*json, name, taken)) {
      if (const auto* const result = std::get_if<CellResult>(&taken)) {
        if (!done[result->cell - name.first]) failures.add(*result);
        done[result->cell - name.first] = true;
      } else {
        timed[std::get<CellTime>(taken).cell - name.first] = true;
      }
    } else {
      return tl::unexpected(damaged(path, number, name).error());
    }
    whole.bytes += line.size() + 1;
  }
  return whole;
}

}  // namespace

Result<ShardWriter> ShardWriter::open(const std::filesystem::path& path, const ShardName& name) {
  ShardWriter out;
  out.path_ = path;
  out.done_.assign(name.end - name.first, false);
  out.timed_ = out.done_;
  std::error_code error;
  Whole whole;
  if (std::filesystem::exists(path, error)) {
    const Result<Whole> found = look_through(path, name, out.done_, out.timed_, out.failures_);
    if (!found) return tl::unexpected(found.error());
    whole = *found;
  }
  out.file_ = ::open(path.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0666);
  if (out.file_ < 0) return fail("can't be written: " + reason(), path.string(), "choose a folder that may be written");
  if (::ftruncate(out.file_, static_cast<off_t>(whole.bytes)) != 0)
    return fail("its torn end can't be cut off: " + reason(), path.string());
  if (!whole.named)
    if (Status ok = out.write(line_of(name_json(name))); !ok) return tl::unexpected(ok.error());
  return out;
}

Status ShardWriter::write(const std::string& line) {
  std::string_view left = line;
  while (!left.empty()) {
    const ssize_t written = ::write(file_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      return fail("can't be written: " + reason(), path_.string(), "what is in it stays; run that shard again");
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Status ShardWriter::add(const CellTime& time) { return write(line_of(time_json(time))); }

Status ShardWriter::add(const CellResult& result) {
  failures_.add(result);
  return write(line_of(result_json(result)));
}

Status ShardWriter::flush() {
  if (::fdatasync(file_) == 0 || errno == EINVAL) return {};
  return fail("can't be written: " + reason(), path_.string(), "what is in it stays; run that shard again");
}

// --- Reading ---------------------------------------------------------------------------------------------

struct ShardReader::Impl {
  std::filesystem::path path;
  ShardName name;
  std::ifstream file;
  std::string line;
  std::uint64_t number = 0;

  Result<bool> next_json(ordered_json& json) {
    if (!std::getline(file, line)) return false;
    ++number;
    auto read = file.eof() ? std::nullopt : read_line(line);
    if (!read) return tl::unexpected(torn(path, number, name).error());
    json = std::move(*read);
    return true;
  }
};

ShardReader::ShardReader() : impl_(std::make_unique<Impl>()) {}
ShardReader::ShardReader(ShardReader&&) noexcept = default;
ShardReader::~ShardReader() = default;

Result<ShardReader> ShardReader::open(const std::filesystem::path& path, const ShardName& name) {
  ShardReader out;
  out.impl_->path = path;
  out.impl_->name = name;
  out.impl_->file.open(path, std::ios::binary);
  if (!out.impl_->file) return fail("can't be read: " + reason(), path.string(), "run " + shard_text(name) + " first");
  ordered_json json;
  const Result<bool> first = out.impl_->next_json(json);
  if (!first) return tl::unexpected(first.error());
  if (!*first) return tl::unexpected(torn(path, 1, name).error());
  if (Status ok = check_name(json, name, path); !ok) return tl::unexpected(ok.error());
  return out;
}

Result<bool> ShardReader::next(ShardLine& line) {
  ordered_json json;
  const Result<bool> more = impl_->next_json(json);
  if (!more || !*more) return more;
  if (!take_line(json, impl_->name, line)) return tl::unexpected(torn(impl_->path, impl_->number, impl_->name).error());
  return true;
}

}  // namespace tangent::sweep
