// Reading one table of a settings file key by key. Each call takes a key if it is there and leaves the value alone if
// not; `finish` says the first thing that was wrong, a key that nobody asked for included, with file, line and what is
// allowed.
#pragma once

#include "core/base/result.h"

#include <toml++/toml.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

class TomlTable {
 public:
  /// `file` and `name` ("[arc]") are for messages; `table` must outlive it.
  TomlTable(const toml::table& table, std::string file, std::string name);

  TomlTable& number(std::string_view key, double& value, double least, double most);
  TomlTable& whole(std::string_view key, int& value, int least, int most);
  TomlTable& flag(std::string_view key, bool& value);
  TomlTable& text(std::string_view key, std::string& value);
  TomlTable& texts(std::string_view key, std::vector<std::string>& values);
  /// `set` gets the index of the choice that was made.
  TomlTable& choice(std::string_view key, std::span<const std::string_view> choices,
                    const std::function<void(std::size_t)>& set);
  /// Three numbers.
  TomlTable& triple(std::string_view key, const std::function<void(double, double, double)>& set, double least,
                    double most);
  /// Hands over the node of a key as it is.
  TomlTable& node(std::string_view key, const std::function<Status(const toml::node&, const std::string& where)>& read);
  /// The key must be there.
  TomlTable& required(std::string_view key);

  Status finish();
  /// "protocol.toml:12 [arc] radius_m"
  std::string where(std::string_view key) const;

 private:
  const toml::node* find(std::string_view key);
  void wrong(std::string_view key, const std::string& wanted);

  const toml::table& table_;
  std::string file_, name_;
  std::vector<std::string> known_;
  Status status_;
};

}  // namespace tangent
