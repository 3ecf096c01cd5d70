// The plots' channels of a tick.
#include "workbench/gui/model/tick_channels.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;

namespace {

float value(const ServoRecord& record, Channel channel) {
  return channel_row(record)[static_cast<std::size_t>(channel)];
}

}  // namespace

TEST_CASE("a tick's numbers go to the channels of their names, in SI") {
  ServoRecord record;
  record.tick.output.force_n = {1.0, -2.0, 2.0};
  record.device.force_command_n = {0.0, -0.3, 0.4};
  record.device.cld_command_m = 0.003;
  record.device.cld_measured_m = 0.002;
  record.tick.output.error_m = 4e-7;
  record.tick.output.iterations = 5;
  record.tick_ns = 2500.0;
  record.device.energy_j = -3e-3;
  CHECK(value(record, Channel::force_x) == 1.0f);
  CHECK(value(record, Channel::force_y) == -2.0f);
  CHECK(value(record, Channel::force_z) == 2.0f);
  CHECK(value(record, Channel::force_computed) == 3.0f);
  CHECK(value(record, Channel::force_felt) == 0.5f);
  CHECK(value(record, Channel::cld_commanded) == 0.003f);
  CHECK(value(record, Channel::cld_measured) == 0.002f);
  CHECK(value(record, Channel::error) == 4e-7f);
  CHECK(value(record, Channel::iterations) == 5.0f);
  CHECK(value(record, Channel::tick_time) == 2.5e-6f);
  CHECK(value(record, Channel::energy) == -3e-3f);
}

TEST_CASE("what was not measured and what did not happen is a gap") {
  ServoRecord record;
  record.tick.output.status = TickStatus::face;
  CHECK(std::isnan(value(record, Channel::tick_time)));
  CHECK(std::isnan(value(record, Channel::event)));
}

TEST_CASE("of what happened in a tick the worst is its mark") {
  ServoRecord record;
  record.tick.output.status = TickStatus::face;
  const auto mark = [&] { return static_cast<EventRank>(value(record, Channel::event)); };
  record.tick.output.event = TickEvent::switched;
  CHECK(mark() == EventRank::moved);
  record.tick.output.event = TickEvent::reseed;
  CHECK(mark() == EventRank::reseeded);
  record.tick.output.status = TickStatus::unconverged;
  CHECK(mark() == EventRank::unconverged);
  record.device.display_fault = DeviceFault::disconnected;
  CHECK(mark() == EventRank::fault);
}
