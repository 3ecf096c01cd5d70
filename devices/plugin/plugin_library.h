// A plug-in loaded into this process, and calls to it with what tangent_device.h promises. Used by the process of its
// own (host/) and, by choice, by the program itself.
#pragma once

#include "core/base/result.h"
#include "devices/plugin/tangent_device.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

using PluginSettings = std::vector<std::pair<std::string, std::string>>;

class PluginLibrary {
 public:
  /// Fails on a file that can't be loaded (elf_check.h), does not export tangent_device_entry, or is of another
  /// version.
  static Result<std::unique_ptr<PluginLibrary>> load(const std::filesystem::path& path, const PluginSettings& settings);
  /// Closes the device and unloads.
  ~PluginLibrary();
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;

  Result<tangent_device_capabilities> capabilities() const;
  Status open();
  void close();
  bool is_open() const { return opened_; }

  /// After open; false: the plug-in says that its device is lost. A sample that it left unfilled is not finite.
  bool exchange(const tangent_device_command& command, tangent_device_sample& sample) noexcept;
  /// After open; any thread.
  void stop() noexcept { table_->stop(device_); }
  /// Never null.
  const char* error_text() const noexcept;

 private:
  struct Settings {
    explicit Settings(const PluginSettings& from);
    std::vector<std::string> texts;
    std::vector<const char*> keys, values;
    tangent_device_settings view{};
  };
  PluginLibrary(std::filesystem::path path, const PluginSettings& settings)
      : path_(std::move(path)), settings_(settings) {}
  Error said(const char* by) const;

  std::filesystem::path path_;
  Settings settings_;
  void* library_ = nullptr;
  const tangent_device_plugin* table_ = nullptr;
  void* device_ = nullptr;
  bool opened_ = false;
};

}  // namespace tangent
