// An app with recorded ticks, and helpers for its tests.
#pragma once

#include "tests/workbench/gui/headless_app.h"
#include "tests/workbench/gui/real_window.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace tangent::test {

/// 1.5 s of simulated exploration on a sphere.
struct RunningApp : HeadlessApp {
  using HeadlessApp::HeadlessApp;
  void run(std::uint64_t ticks = 1500) {
    app().advance(ticks);
    frame();
    REQUIRE(model().time().end_tick() >= ticks);
  }
};

inline bool said(const AppModel& model, Severity severity, const char* part) {
  for (const Message& m : model.messages().all()) {
    if (m.severity == severity && m.text.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace tangent::test
