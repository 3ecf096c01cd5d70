#include "core/io/preset_values.h"

#include "core/base/text.h"
#include "core/io/toml_text.h"

#include <vector>

namespace tangent {
namespace {

Status unknown_key(std::string_view table, const std::string& at) {
  std::vector<std::string_view> known;
  for (const PresetKey& k : preset_keys()) {
    if (k.table == table) known.push_back(k.key);
  }
  return fail("unknown key", at, "allowed: " + choices_text(known));
}

}  // namespace

Status read_preset_value(std::string_view table, const toml::key& key, const toml::node& node, const std::string& where,
                         Preset& preset) {
  const std::string at = where + " " + std::string(table) + "." + std::string(key.str());
  const PresetKey* row = find_preset_key(table, key.str());
  if (row == nullptr) return unknown_key(table, at);
  const auto wrong_type = [&] { return fail("is " + std::string(type_name(node)), at, "allowed: " + row->allowed()); };
  double value = 0.0;
  std::string shown;
  if (row->kind == KeyKind::choice) {
    if (!node.is_string()) return wrong_type();
    value = row->choice_index(node.as_string()->get());
    shown = "\"" + node.as_string()->get() + "\"";
  } else if (node.is_integer()) {
    value = static_cast<double>(node.as_integer()->get());
    append_double(shown, value);
  } else if (node.is_floating_point() && row->kind == KeyKind::number) {
    value = node.as_floating_point()->get();
    append_double(shown, value);
  } else {
    return wrong_type();
  }
  if (!row->allows(value)) return fail(shown + " is out of range", at, "allowed: " + row->allowed());
  row->set(preset, value);
  return {};
}

std::string value_literal(const PresetKey& row, double value) {
  switch (row.kind) {
    case KeyKind::choice:
      return "\"" + row.value_text(value) + "\"";
    case KeyKind::integer:
      return row.value_text(value);
    default:
      return float_text(value);
  }
}

}  // namespace tangent
