#include "core/io/toml_table.h"

#include "core/base/text.h"
#include "core/io/toml_text.h"
#include "core/preset/schema.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tangent {
namespace {

/// A value as it is written; of what is long its type.
std::string shown_value(const toml::node& node) {
  std::string out;
  if (const auto* number = node.as_floating_point())
    append_double(out, number->get());
  else if (const auto* whole = node.as_integer())
    out = std::to_string(whole->get());
  else if (const auto* flag = node.as_boolean())
    out = flag->get() ? "true" : "false";
  else if (const auto* text = node.as_string(); text != nullptr && text->get().size() <= 40)
    out = "\"" + text->get() + "\"";
  else
    out = type_name(node);
  return out;
}

}  // namespace

TomlTable::TomlTable(const toml::table& table, std::string file, std::string name)
    : table_(table), file_(std::move(file)), name_(std::move(name)) {}

std::string TomlTable::where(std::string_view key) const {
  const toml::node* node = table_.get(key);
  const auto line = (node != nullptr ? node->source() : table_.source()).begin.line;
  return file_ + ":" + std::to_string(line) + " " + name_ + " " + std::string(key);
}

const toml::node* TomlTable::find(std::string_view key) {
  known_.emplace_back(key);
  return status_ ? table_.get(key) : nullptr;
}

void TomlTable::wrong(std::string_view key, const std::string& wanted) {
  status_ = fail("is " + shown_value(*table_.get(key)) + ", which is not allowed", where(key), "write " + wanted);
}

TomlTable& TomlTable::number(std::string_view key, double& value, double least, double most) {
  const toml::node* node = find(key);
  if (node == nullptr) return *this;
  const auto read = node->value<double>();
  if (!node->is_number() || !(*read >= least && *read <= most))
    wrong(key, "a number, " + range_text(least, most, ""));
  else
    value = *read;
  return *this;
}

TomlTable& TomlTable::whole(std::string_view key, int& value, int least, int most) {
  const toml::node* node = find(key);
  if (node == nullptr) return *this;
  const auto read = node->value_exact<std::int64_t>();
  if (!read || *read < least || *read > most)
    wrong(key, "a whole number, " + std::to_string(least) + " to " + std::to_string(most));
  else
    value = static_cast<int>(*read);
  return *this;
}

TomlTable& TomlTable::flag(std::string_view key, bool& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return *this;
  if (const auto read = node->value_exact<bool>())
    value = *read;
  else
    wrong(key, "true or false");
  return *this;
}

TomlTable& TomlTable::text(std::string_view key, std::string& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return *this;
  if (const auto read = node->value_exact<std::string>(); read && !read->empty())
    value = *read;
  else
    wrong(key, "text in quotes");
  return *this;
}

TomlTable& TomlTable::texts(std::string_view key, std::vector<std::string>& values) {
  const toml::node* node = find(key);
  if (node == nullptr) return *this;
  std::vector<std::string> read;
  if (const toml::array* list = node->as_array())
    for (const toml::node& item : *list)
      if (const auto one = item.value_exact<std::string>()) read.push_back(*one);
  if (!node->is_array() || read.size() != node->as_array()->size())
    wrong(key, "a list of texts in quotes");
  else
    values = std::move(read);
  return *this;
}

TomlTable& TomlTable::choice(std::string_view key, std::span<const std::string_view> choices,
                             const std::function<void(std::size_t)>& set) {
  const toml::node* node = find(key);
  if (node == nullptr) return *this;
  const auto read = node->value_exact<std::string>();
  const auto at = read ? std::find(choices.begin(), choices.end(), *read) : choices.end();
  if (at == choices.end())
    wrong(key, "one of: " + choices_text(choices));
  else
    set(static_cast<std::size_t>(at - choices.begin()));
  return *this;
}

TomlTable& TomlTable::triple(std::string_view key, const std::function<void(double, double, double)>& set, double least,
                             double most) {
  const toml::node* node = find(key);
  if (node == nullptr) return *this;
  std::vector<double> read;
  if (const toml::array* list = node->as_array())
    for (const toml::node& item : *list)
      if (const auto one = item.value<double>(); item.is_number() && *one >= least && *one <= most)
        read.push_back(*one);
  if (read.size() != 3 || node->as_array()->size() != 3)
    wrong(key, "three numbers, " + range_text(least, most, "") + " each");
  else
    set(read[0], read[1], read[2]);
  return *this;
}

TomlTable& TomlTable::node(std::string_view key,
                           const std::function<Status(const toml::node&, const std::string&)>& read) {
  const toml::node* node = find(key);
  if (node != nullptr) status_ = read(*node, where(key));
  return *this;
}

TomlTable& TomlTable::required(std::string_view key) {
  if (status_ && table_.get(key) == nullptr)
    status_ = fail("is missing", file_ + " " + name_ + " " + std::string(key), "write it");
  return *this;
}

Status TomlTable::finish() {
  if (!status_) return status_;
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    std::vector<std::string_view> names(known_.begin(), known_.end());
    return fail("unknown key",
                file_ + ":" + std::to_string(key.source().begin.line) + " " + name_ + " " + std::string(key.str()),
                "allowed: " + choices_text(names));
  }
  return status_;
}

}  // namespace tangent
