// The C interface: presets.
#include "core/io/preset_file.h"
#include "core/preset/schema.h"
#include "workbench/embed/c_handle.h"

#include <string>

namespace tangent::c {
namespace {

/// Null, with the error's text in the handle: no such key.
const PresetKey* find_key(tangent_preset& handle, const char* name) {
  const PresetKey* key = find_preset_key(name);
  if (key == nullptr)
    handle.error.set(Error{"there is no such key", name, "tangent_preset_key names all, as presets/default.toml does"});
  return key;
}

/// Names and choices without their end, as the table has them: constants of the program, which are followed by a zero.
const char* terminated(const std::string& text, std::string& kept) {
  kept = text;
  return kept.c_str();
}

}  // namespace
}  // namespace tangent::c

using namespace tangent;

tangent_status tangent_make_preset(uint32_t version, tangent_preset** preset) {
  return c::make_handle(version, preset, [](tangent_preset& handle) {
    handle.usable = true;
    return TANGENT_OK;
  });
}

tangent_status tangent_read_preset(uint32_t version, const char* path, tangent_preset** preset) {
  return c::make_handle(version, preset, [&](tangent_preset& handle) {
    if (path == nullptr)
      return c::fail_with(handle, {"path is null", "tangent_read_preset", "name a file"}, TANGENT_NULL);
    Result<PresetFile> file = read_preset(path);
    if (!file) return c::fail_with(handle, file.error());
    handle.preset = file->preset;
    handle.usable = true;
    return TANGENT_OK;
  });
}

tangent_status tangent_write_preset(tangent_preset* preset, const char* path) {
  if (preset == nullptr || path == nullptr || !preset->usable) return TANGENT_NULL;
  return c::run_guarded(*preset, [&] {
    PresetFile file;
    file.preset = preset->preset;
    const Status written = write_preset(file, path);
    return written ? TANGENT_OK : c::fail_with(*preset, written.error());
  });
}

const char* tangent_preset_key(size_t index) {
  if (index >= preset_keys().size()) return nullptr;
  thread_local std::string name;
  return c::terminated(preset_keys()[index].full_name(), name);
}

const char* tangent_preset_choice(const char* key, size_t index) {
  const PresetKey* found = key ? find_preset_key(key) : nullptr;
  if (found == nullptr || index >= found->choices.size()) return nullptr;
  thread_local std::string name;
  return c::terminated(std::string(found->choices[index]), name);
}

tangent_status tangent_get_value(tangent_preset* preset, const char* key, double* value) {
  if (preset == nullptr || key == nullptr || value == nullptr || !preset->usable) return TANGENT_NULL;
  return c::run_guarded(*preset, [&] {
    const PresetKey* found = c::find_key(*preset, key);
    if (found == nullptr) return TANGENT_FAILED;
    *value = found->get(preset->preset);
    return TANGENT_OK;
  });
}

tangent_status tangent_set_value(tangent_preset* preset, const char* key, double value) {
  if (preset == nullptr || key == nullptr || !preset->usable) return TANGENT_NULL;
  return c::run_guarded(*preset, [&] {
    const PresetKey* found = c::find_key(*preset, key);
    if (found == nullptr) return TANGENT_FAILED;
    if (!found->allows(value))
      return c::fail_with(*preset, {std::to_string(value) + " is not allowed", key, "allowed: " + found->allowed()});
    Preset changed = preset->preset;
    found->set(changed, value);
    if (const Status whole = check_preset(changed); !whole) return c::fail_with(*preset, whole.error());
    preset->preset = changed;
    return TANGENT_OK;
  });
}

const char* tangent_preset_error(const tangent_preset* preset) {
  return preset ? preset->error.get() : tangent_status_text(TANGENT_NULL);
}

void tangent_free_preset(tangent_preset* preset) { delete preset; }
