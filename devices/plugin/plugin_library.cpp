#include "devices/plugin/plugin_library.h"

#include "devices/plugin/elf_check.h"

#include <dlfcn.h>

#include <cstring>
#include <limits>

namespace tangent {

namespace {

constexpr const char* kEntry = "tangent_device_entry";

Status check_table(const tangent_device_plugin* table, const std::string& where) {
  const std::string ours = std::to_string(TANGENT_DEVICE_VERSION);
  if (table == nullptr)
    return fail("can't work with version " + ours + " of tangent_device.h", where,
                "compile it with this workbench's tangent_device.h");
  if (table->version != TANGENT_DEVICE_VERSION || table->size < sizeof(tangent_device_plugin))
    return fail("is of version " + std::to_string(table->version) + " of tangent_device.h, with a table of " +
                    std::to_string(table->size) + " bytes; this workbench's is version " + ours + ", of " +
                    std::to_string(sizeof(tangent_device_plugin)) + " bytes",
                where, "compile it with this workbench's tangent_device.h");
  const bool whole = table->capabilities != nullptr && table->open != nullptr && table->exchange != nullptr &&
                     table->stop != nullptr && table->close != nullptr && table->error_text != nullptr;
  if (whole) return {};
  return fail("its table lacks a function", where,
              "fill in capabilities, open, exchange, stop, close and error_text (devices/plugin/template)");
}

}  // namespace

PluginLibrary::Settings::Settings(const PluginSettings& from) {
  for (const auto& [key, value] : from) {
    texts.push_back(key);
    texts.push_back(value);
  }
  for (std::size_t i = 0; i < texts.size(); i += 2) {
    keys.push_back(texts[i].c_str());
    values.push_back(texts[i + 1].c_str());
  }
  view = {sizeof view, static_cast<std::uint32_t>(keys.size()), keys.data(), values.data()};
}

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::load(const std::filesystem::path& path,
                                                           const PluginSettings& settings) {
  if (const Status ok = check_shared_library(path); !ok) return tl::unexpected(ok.error());
  const std::string where = path.string();
  std::error_code lost;
  const std::filesystem::path whole = std::filesystem::absolute(path, lost);  // or the linker looks in its own folders
  if (lost) return fail("the folder that this program runs in is gone", where, "give --plugin a whole path");
  std::unique_ptr<PluginLibrary> made(new PluginLibrary(whole, settings));
  // All is bound now: not in the first exchange.
  made->library_ = ::dlopen(made->path_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (made->library_ == nullptr)
    return fail(std::string("can't be loaded: ") + ::dlerror(), where,
                "install what it says is missing (ldd " + where + "), or link the plug-in with it");
  const auto entry = reinterpret_cast<tangent_device_entry_function>(::dlsym(made->library_, kEntry));
  if (entry == nullptr)
    return fail(std::string("does not export ") + kEntry, where,
                "it is no plug-in for this workbench; in C++ the function has to be extern \"C\"");
  made->table_ = entry(TANGENT_DEVICE_VERSION);
  if (const Status ok = check_table(made->table_, where); !ok) return tl::unexpected(ok.error());
  return made;
}

PluginLibrary::~PluginLibrary() {
  close();
  if (library_ != nullptr) ::dlclose(library_);
}

const char* PluginLibrary::error_text() const noexcept {
  const char* text = table_->error_text(device_);
  return text != nullptr && *text != '\0' ? text : "it does not say why";
}

Error PluginLibrary::said(const char* by) const {
  return {std::string(by) + " failed: " + error_text(), path_.string(), "see to what the plug-in says"};
}

Result<tangent_device_capabilities> PluginLibrary::capabilities() const {
  // Whole and ended, so that what was said twice can be compared byte by byte.
  const auto tidy = [](auto& text) {
    text[sizeof text - 1] = '\0';
    const std::size_t used = std::strlen(text);
    std::memset(text + used, 0, sizeof text - used);
  };
  tangent_device_capabilities can{};
  can.size = sizeof can;
  can.frame_rotation[0] = 1.0;
  if (table_->capabilities(&settings_.view, &can) != 0) return tl::unexpected(said("capabilities"));
  tidy(can.name);
  tidy(can.serial);
  can.size = sizeof can;
  return can;
}

Status PluginLibrary::open() {
  if (opened_) return {};
  void* device = nullptr;
  if (table_->open(&settings_.view, &device) != 0) return tl::unexpected(said("open"));
  device_ = device;
  opened_ = true;
  return {};
}

void PluginLibrary::close() {
  if (!opened_) return;
  table_->stop(device_);
  table_->close(device_);
  opened_ = false;
  device_ = nullptr;
}

bool PluginLibrary::exchange(const tangent_device_command& command, tangent_device_sample& sample) noexcept {
  constexpr double kUnfilled = std::numeric_limits<double>::quiet_NaN();
  sample = {};
  sample.size = sizeof sample;
  sample.time_s = kUnfilled;
  for (double& value : sample.position_m) value = kUnfilled;
  return table_->exchange(device_, &command, &sample) == 0;
}

}  // namespace tangent
