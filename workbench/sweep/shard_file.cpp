#include "workbench/sweep/shard_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace tangent::sweep {
namespace {

using nlohmann::ordered_json;

constexpr int kShardFormat = 2;  // 2: counted times, and times
std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Empty: it is no object.
std::optional<ordered_json> read_text(std::string_view text) {
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

LineFileRules rules_of(const ShardName& name) {
  return {.damaged = "remove it, and run " + shard_text(name) + " again",
          .append = {.not_whole = "what is in it stays; run that shard again"}};
}

/// The line before the end, cut off while it was written.
Status torn(const std::filesystem::path& path, std::uint64_t line, const ShardName& name) {
  return fail("line " + std::to_string(line) + " is torn", path.string(),
              "run " + shard_text(name) + " again: it goes on from what is whole");
}

}  // namespace

ShardName shard_of(const std::string& plan, std::uint64_t cells, std::uint64_t shard, std::uint64_t shards) {
  const std::uint64_t each = cells / shards, more = cells % shards;  // the first `more` have one more
  const std::uint64_t first = shard * each + std::min(shard, more);
  return {plan, shard, shards, first, first + each + (shard < more ? 1 : 0)};
}

// --- Writing ---------------------------------------------------------------------------------------------

Status ShardWriter::take(std::string_view text, std::uint64_t number, const ShardName& name,
                         const std::filesystem::path& path) {
  const auto json = read_text(text);
  if (json && number == 1) return check_name(*json, name, path);
  ShardLine taken;
  if (!json || !take_line(*json, name, taken)) return LineFile::damaged(path, number, rules_of(name));
  if (const auto* const result = std::get_if<CellResult>(&taken)) {
    if (!done_[result->cell - name.first]) failures_.add(*result);
    done_[result->cell - name.first] = true;
  } else {
    timed_[std::get<CellTime>(taken).cell - name.first] = true;
  }
  return {};
}

Result<ShardWriter> ShardWriter::open(const std::filesystem::path& path, const ShardName& name) {
  ShardWriter out;
  out.done_.assign(name.end - name.first, false);
  out.timed_ = out.done_;
  bool named = false;
  const auto take = [&](std::string_view text, std::uint64_t number) {
    named = true;
    return out.take(text, number, name, path);
  };
  Result<LineFile> file = LineFile::open(path, take, rules_of(name));
  if (!file) return tl::unexpected(file.error());
  out.file_.emplace(std::move(*file));
  if (!named)
    if (Status ok = out.file_->add(text_of(name_json(name))); !ok) return tl::unexpected(ok.error());
  return out;
}

Status ShardWriter::add(const CellTime& time) { return file_->add(text_of(time_json(time))); }

Status ShardWriter::add(const CellResult& result) {
  failures_.add(result);
  return file_->add(text_of(result_json(result)));
}

Status ShardWriter::flush() { return file_->flush(); }

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
    const auto text = file.eof() ? std::nullopt : checked_text(line);
    auto read = text ? read_text(*text) : std::nullopt;
    if (!read) return tl::unexpected(unreadable().error());
    json = std::move(*read);
    return true;
  }

  /// Of the line that was read last: what the writer does about it.
  Status unreadable() {
    const bool last = file.eof() || file.peek() == std::ifstream::traits_type::eof();
    return last ? torn(path, number, name) : LineFile::damaged(path, number, rules_of(name));
  }
};

ShardReader::ShardReader() : impl_(std::make_unique<Impl>()) {}
ShardReader::ShardReader(ShardReader&&) noexcept = default;
ShardReader::~ShardReader() = default;

Result<ShardReader> ShardReader::open(const std::filesystem::path& path, const ShardName& name) {
  ShardReader out;
  out.impl_->path = path;
  out.impl_->name = name;
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))  // a pipe would wait
    return fail("is no file", path.string(), "remove it, and run " + shard_text(name) + " again");
  out.impl_->file.open(path, std::ios::binary);
  if (!out.impl_->file)
    return fail(std::string("can't be read: ") + std::strerror(errno), path.string(),
                "run " + shard_text(name) + " first");
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
  if (!take_line(json, impl_->name, line))
    return tl::unexpected(LineFile::damaged(impl_->path, impl_->number, rules_of(impl_->name)).error());
  return true;
}

}  // namespace tangent::sweep
