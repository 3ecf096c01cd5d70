#include "workbench/recording/export.h"

#include "core/io/ticks_file.h"
#include "tests/workbench/recording/recording_fixture.h"
#include "workbench/recording/mcap_file.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <cstring>
#include <map>

using namespace tangent;
using namespace tangent::test;

namespace {

const std::string& recorded_second() {
  static const testing::TempFolder folder;
  static const std::string path = [] {
    std::string made = folder.file("a.sqlite");
    RecordedSession recorded(made);
    recorded.run(1000);
    recorded.finish();
    return made;
  }();
  return path;
}

/// Little-endian values in turn.
struct Bytes {
  std::string_view left;
  template <class T>
  T number() {
    T value{};
    REQUIRE(left.size() >= sizeof value);
    std::memcpy(&value, left.data(), sizeof value);
    left.remove_prefix(sizeof value);
    return value;
  }
  std::string_view take(std::size_t size) {
    REQUIRE(left.size() >= size);
    const std::string_view part = left.substr(0, size);
    left.remove_prefix(size);
    return part;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
};

struct McapMessage {
  std::string topic;
  std::uint64_t time_ns = 0;
  nlohmann::json value;
};

/// Reads the messages by the chunks' indexes, as a viewer does, and checks what the file says of itself.
std::vector<McapMessage> messages_of(const std::string& file) {
  constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
  REQUIRE(file.size() > 37);
  CHECK(file.substr(0, 8) == kMagic);
  CHECK(file.substr(file.size() - 8) == kMagic);
  Bytes footer{std::string_view(file).substr(file.size() - 8 - 29, 29)};
  CHECK(footer.number<std::uint8_t>() == 2);
  CHECK(footer.number<std::uint64_t>() == 20);
  Bytes summary{std::string_view(file).substr(footer.number<std::uint64_t>())};
  std::map<int, std::string> topics;
  std::vector<McapMessage> found;
  std::uint64_t counted = 0;
  for (int op = summary.number<std::uint8_t>(); op != 2; op = summary.number<std::uint8_t>()) {
    Bytes record{summary.take(summary.number<std::uint64_t>())};
    if (op == 3) {
      record.number<std::uint16_t>();
      CHECK_FALSE(record.text().empty());
      CHECK(record.text() == "jsonschema");
      CHECK(nlohmann::json::parse(record.text())["type"] == "object");
    } else if (op == 4) {
      const auto id = record.number<std::uint16_t>();
      record.number<std::uint16_t>();
      topics[id] = record.text();
      CHECK(record.text() == "json");
    } else if (op == 8) {
      const auto first = record.number<std::uint64_t>(), last = record.number<std::uint64_t>();
      const auto at = record.number<std::uint64_t>(), length = record.number<std::uint64_t>();
      Bytes chunk{std::string_view(file).substr(at, length)};
      CHECK(chunk.number<std::uint8_t>() == 6);
      const auto content = chunk.number<std::uint64_t>();
      CHECK(content == chunk.left.size());
      CHECK(chunk.number<std::uint64_t>() == first);
      CHECK(chunk.number<std::uint64_t>() == last);
      const auto size = chunk.number<std::uint64_t>();
      chunk.number<std::uint32_t>();
      CHECK(chunk.text().empty());
      CHECK(chunk.number<std::uint64_t>() == size);
      const std::string_view records = chunk.take(size);
      Bytes places{record.text()};
      while (!places.left.empty()) {
        const auto channel = places.number<std::uint16_t>();
        Bytes index{std::string_view(file).substr(places.number<std::uint64_t>())};
        CHECK(index.number<std::uint8_t>() == 7);
        index.number<std::uint64_t>();
        CHECK(index.number<std::uint16_t>() == channel);
        Bytes entries{index.text()};
        while (!entries.left.empty()) {
          const auto time = entries.number<std::uint64_t>();
          Bytes message{records.substr(entries.number<std::uint64_t>())};
          CHECK(message.number<std::uint8_t>() == 5);
          const auto bytes = message.number<std::uint64_t>();
          CHECK(message.number<std::uint16_t>() == channel);
          message.number<std::uint32_t>();
          CHECK(message.number<std::uint64_t>() == time);
          CHECK(time >= first);
          CHECK(time <= last);
          message.number<std::uint64_t>();
          found.push_back({topics.at(channel), time, nlohmann::json::parse(message.take(bytes - 22))});
        }
      }
    } else if (op == 11) {
      counted = record.number<std::uint64_t>();
    }
  }
  CHECK(counted == found.size());
  return found;
}

}  // namespace

TEST_CASE("an exported CSV is what solve would have written of these ticks") {
  const testing::TempFolder folder;
  const std::string csv = folder.file("a.csv");
  const auto count = export_ticks(recorded_second(), csv);
  REQUIRE_MESSAGE(count, (count ? "" : message_of(count.error())));
  CHECK(*count == 1000);
  std::string expected = std::string(kTicksHeader) + "\n";
  for (const RecordedTick& tick : all_ticks(recorded_second())) {
    const TickRecord& t = tick.record.tick;
    REQUIRE(append_tick_row(expected, {t.tick, t.input.t_s, t.output, t.solve_ns}));
  }
  CHECK(testing::read_text(csv) == expected);
}

TEST_CASE("a selection of time and channels is exported, and an unknown channel named with those that there are") {
  const testing::TempFolder folder;
  const std::string csv = folder.file("a.csv");
  ExportOptions options;
  options.from_s = 0.2;
  options.to_s = 0.3;
  options.channels = {"force_z_n", "gate_state"};
  const auto count = export_ticks(recorded_second(), csv, options);
  REQUIRE(count);
  const std::string text = testing::read_text(csv);
  CHECK(text.starts_with("tick,t_s,force_z_n,gate_state\n200,0.2,"));
  CHECK(*count == 101);
  CHECK(says(text, "disarmed"));
  options.channels = {"weight_kg"};
  const auto unknown = export_ticks(recorded_second(), folder.file("b.csv"), options);
  REQUIRE_FALSE(unknown);
  CHECK(says(message_of(unknown.error()), "force_z_n"));
  CHECK_FALSE(export_ticks(recorded_second(), folder.file("b.docx")));
  options = {};
  options.from_s = 77.0;
  CHECK_FALSE(export_ticks(recorded_second(), folder.file("b.csv"), options));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("an exported MCAP has every tick on named, typed channels") {
  const testing::TempFolder folder;
  const std::string mcap = folder.file("a.mcap");
  REQUIRE(export_ticks(recorded_second(), mcap));
  const std::vector<McapMessage> messages = messages_of(testing::read_text(mcap));
  const std::vector<RecordedTick> ticks = all_ticks(recorded_second());
  std::map<std::string, std::size_t> by_topic;
  for (const McapMessage& message : messages) {
    ++by_topic[message.topic];
    const RecordedTick& tick = ticks.at(message.value["tick"].get<std::size_t>());
    CHECK(message.time_ns == static_cast<std::uint64_t>(std::llround(tick.record.tick.input.t_s * 1e9)));
    if (message.topic == "/force") CHECK(message.value["force_x_n"] == tick.record.tick.output.force_n.x);
    if (message.topic == "/contact") CHECK(message.value["status"] == to_string(tick.record.tick.output.status));
  }
  for (const char* topic : {"/contact", "/force", "/display", "/solver", "/finger", "/hand", "/timing", "/devices"})
    CHECK(by_topic[topic] == ticks.size());
}

TEST_CASE("the reference reader of MCAP files reads an exported one") {
  if (std::system("node -e \"require('@mcap/core')\" >/dev/null 2>&1") != 0) {
    MESSAGE("skipped: node does not find @mcap/core (npm install -g @mcap/core, NODE_PATH)");
    return;
  }
  const testing::TempFolder folder;
  const std::string mcap = folder.file("a.mcap");
  REQUIRE(export_ticks(recorded_second(), mcap));
  const std::string script = folder.write("read.cjs", R"(
const fs = require('fs'), { McapIndexedReader } = require('@mcap/core');
const bytes = fs.readFileSync(process.argv[2]);
const readable = { size: async () => BigInt(bytes.length),
  read: async (at, length) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(at), Number(length)) };
(async () => {
  const reader = await McapIndexedReader.Initialize({ readable });
  let count = 0, force = 0;
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = JSON.parse(new TextDecoder().decode(reader.schemasById.get(channel.schemaId).data));
    const value = JSON.parse(new TextDecoder().decode(message.data));
    for (const key of Object.keys(value)) if (!schema.properties[key]) throw new Error(key);
    ++count;
    if (channel.topic === '/force') ++force;
  }
  console.log(count, force, reader.channelsById.size);
})();
)");
  const std::string said = folder.file("said");
  REQUIRE(std::system(("node " + script + " " + mcap + " >" + said + " 2>&1").c_str()) == 0);
  CHECK(testing::read_text(said) == "8000 1000 8\n");
}
