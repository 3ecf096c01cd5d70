#include "workbench/gui/model/message_log.h"

#include <doctest/doctest.h>

namespace tangent {
namespace {

TEST_CASE("messages that are held back are more than those shown, or new where none is shown") {
  MessageLog log;
  for (int i = 0; i < 6; ++i) log.add(Severity::note, "note " + std::to_string(i), 10.0);
  CHECK(log.held_back_text(10.5, true) == "and 2 more under Messages");
  log.add(Severity::note, "late", 14.9);  // shown: one each two seconds
  log.add(Severity::note, "later", 14.9);
  log.add(Severity::note, "last", 14.9);
  CHECK(log.held_back_text(16.0, false) == "1 new under Messages");
  CHECK(log.held_back_text(30.0, false).empty());
}

}  // namespace
}  // namespace tangent
