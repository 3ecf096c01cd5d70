#include "core/io/file_format.h"

namespace tangent {

std::string FileFormats::line() const { return std::string(kFormatKey) + " = " + std::to_string(newest()) + "\n"; }

Status migrate(toml::table& root, const FileFormats& formats, std::string_view name) {
  std::int64_t format = 0;
  if (const toml::node* node = root.get(kFormatKey)) {
    const std::string newest = std::to_string(formats.newest()), kind(formats.kind);
    const std::string where =
        std::string(name) + ":" + std::to_string(node->source().begin.line) + " " + std::string(kFormatKey);
    const toml::value<std::int64_t>* number = node->as_integer();
    if (number == nullptr || number->get() < 0)
      return fail("is not a format of a " + kind + " file", where, "allowed: a whole number from 0 to " + newest);
    format = number->get();
    if (format > formats.newest())
      return fail("this file has format " + std::to_string(format) + ", this program reads up to " + newest, where,
                  "use the program that wrote it or a newer one, or write the " + kind + " file again with this one");
    root.erase(kFormatKey);
  }
  for (const MigrationStep step : formats.steps.subspan(static_cast<std::size_t>(format))) step(root);
  return {};
}

}  // namespace tangent
