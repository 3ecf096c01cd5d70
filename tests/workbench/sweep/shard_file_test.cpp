#include "tests/workbench/sweep/sweep_fixture.h"

namespace tangent::sweep {
namespace {

using testing::bytes_of;
using testing::FullDisk;
using testing::SmallSweep;

const ShardName kShard{"0123456789abcdef", 1, 3, 4, 8};

CellResult some_result(std::uint64_t cell) {
  CellResult result{cell, cell == 5 ? "torus.obj:1: is \"broken\"\n" : "", {}};
  if (result.failed.empty()) {
    result.numbers.ticks = 1000 + cell;
    result.numbers.error_p50_m = 1.0 / (3.0 + static_cast<double>(cell));
    result.numbers.error_worst_m = 4.9e-324;
  }
  return result;
}

std::string write_shard(const std::string& path) {
  auto writer = ShardWriter::open(path, kShard);
  REQUIRE_MESSAGE(writer, writer.error().message());
  for (std::uint64_t cell = 4; cell < 8; ++cell)
    if (!writer->done()[cell - 4]) REQUIRE(writer->add(some_result(cell)));
  return bytes_of(path);
}

CellTime some_time(std::uint64_t cell) {
  CellTime out;
  out.cell = cell;
  out.against = 4;
  out.machine = "node \"7\", Some processor";
  out.time = {1000.0 / 3.0, 300.0, 10.0 / 9.0, 1.1, 1.2, 6, TimeVerdict::slower, std::nullopt};
  if (cell > 4) out.time.instructions = 1e4 / 3.0;
  return out;
}

/// Of two of its cells.
std::string write_times(const std::string& path) {
  auto writer = ShardWriter::open(path, kShard);
  REQUIRE_MESSAGE(writer, writer.error().message());
  for (const std::uint64_t cell : {4, 6})
    if (!writer->timed()[cell - 4]) REQUIRE(writer->add(some_time(cell)));
  return bytes_of(path);
}

/// What is read, in order; or what it says.
Result<std::vector<CellResult>> read_shard(const std::string& path) {
  auto reader = ShardReader::open(path, kShard);
  if (!reader) return tl::unexpected(reader.error());
  std::vector<CellResult> out;
  ShardLine line;
  for (;;) {
    const Result<bool> more = reader->next(line);
    if (!more) return tl::unexpected(more.error());
    if (!*more) return out;
    if (const auto* const result = std::get_if<CellResult>(&line)) out.push_back(*result);
  }
}

TEST_CASE("a shard reads back as it was written, to the bit") {
  const SmallSweep sweep;
  write_shard(sweep.file("s.jsonl"));
  const auto read = read_shard(sweep.file("s.jsonl"));
  REQUIRE_MESSAGE(read, read.error().message());
  REQUIRE(read->size() == 4);
  for (std::uint64_t i = 0; i < 4; ++i) CHECK((*read)[i] == some_result(i + 4));
}

TEST_CASE("a shard cut off after any byte is gone on with, and refused by name before that") {
  const SmallSweep sweep;
  const std::string path = sweep.file("cut.jsonl");
  write_shard(sweep.file("whole.jsonl"));
  const std::string whole = write_times(sweep.file("whole.jsonl"));
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    sweep.write("cut.jsonl", whole.substr(0, bytes));
    const auto read = read_shard(path);
    const bool at_a_line = bytes > 0 && whole[bytes - 1] == '\n';
    CHECK(read.has_value() == at_a_line);
    if (!read) CHECK(read.error().message().find("cut.jsonl") != std::string::npos);
    write_shard(path);
    CHECK(write_times(path) == whole);
  }
}

TEST_CASE("times of a shard read back to the bit, beside its cells") {
  const SmallSweep sweep;
  write_shard(sweep.file("s.jsonl"));
  write_times(sweep.file("s.jsonl"));
  auto reader = ShardReader::open(sweep.file("s.jsonl"), kShard);
  REQUIRE(reader);
  ShardLine line;
  std::vector<CellTime> times;
  while (*reader->next(line))
    if (const auto* const time = std::get_if<CellTime>(&line)) times.push_back(*time);
  REQUIRE(times.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const CellTime wanted = some_time(4 + 2 * i);
    CHECK(times[i].cell == wanted.cell);
    CHECK(times[i].against == 4);
    CHECK(times[i].machine == wanted.machine);
    CHECK(times[i].time.ns == wanted.time.ns);
    CHECK(times[i].time.ratio == wanted.time.ratio);
    CHECK(times[i].time.rounds == 6);
    CHECK(times[i].time.verdict == TimeVerdict::slower);
    CHECK(times[i].time.instructions == wanted.time.instructions);
  }
}

TEST_CASE("a shard on a full disk keeps its whole lines, says so, and is gone on with") {
  const SmallSweep sweep;
  const std::string path = sweep.file("s.jsonl"), whole = write_shard(sweep.file("whole.jsonl"));
  {
    auto writer = ShardWriter::open(path, kShard);
    REQUIRE(writer);
    REQUIRE(writer->add(some_result(4)));
    const FullDisk full(std::filesystem::file_size(path) + 100);  // room for a part of the next line
    const Status failed = writer->add(some_result(6));
    REQUIRE(!failed);
    CHECK(failed.error().message().find("s.jsonl") != std::string::npos);
    CHECK(failed.error().message().find("run that shard again") != std::string::npos);
  }
  auto again = ShardWriter::open(path, kShard);
  REQUIRE(again);
  CHECK(again->done() == std::vector<bool>{true, false, false, false});
  write_shard(path);
  CHECK(bytes_of(path) == whole);
}

TEST_CASE("a damaged line, another plan and a newer program are refused by name") {
  const SmallSweep sweep;
  const std::string whole = write_shard(sweep.file("whole.jsonl")), path = sweep.file("s.jsonl");
  const auto said = [&](const ShardName& name) {
    const auto writer = ShardWriter::open(path, name);
    const auto reader = ShardReader::open(path, name);
    CHECK(writer.has_value() == reader.has_value());
    return writer ? std::string() : writer.error().message();
  };
  std::string damaged = whole;
  damaged[whole.find('\n') + 40] ^= 1;
  sweep.write("s.jsonl", damaged);
  CHECK(ShardWriter::open(path, kShard).error().message().find("line 2") != std::string::npos);
  CHECK(read_shard(path).error().message() == ShardWriter::open(path, kShard).error().message());
  CHECK(read_shard(path).error().remedy.find("remove it") != std::string::npos);
  sweep.write("s.jsonl", whole.substr(0, whole.size() - 7));
  CHECK(read_shard(path).error().message().find("is torn; run shard 1 of 3 again") != std::string::npos);
  for (const char* const name : {".", "/dev/zero"}) {  // nothing that would be waited for, or never ends
    CHECK(ShardReader::open(name, kShard).error().what == "is no file");
    CHECK(ShardWriter::open(name, kShard).error().what == "is no file");
  }

  sweep.write("s.jsonl", whole);
  ShardName other = kShard;
  other.plan = "fedcba9876543210";
  CHECK(said(other).find("another plan or shard") != std::string::npos);
  other = kShard;
  other.shard = 2;
  CHECK(said(other).find("another plan or shard") != std::string::npos);
  CHECK(bytes_of(path) == whole);  // refusing changes nothing
  CHECK(!ShardReader::open(sweep.file("none.jsonl"), kShard));
}

TEST_CASE("shards share the cells out, each once") {
  for (const std::uint64_t cells : {1, 7, 16, 1000}) {
    for (std::uint64_t shards = 1; shards <= std::min<std::uint64_t>(cells, 9); ++shards) {
      std::uint64_t next = 0;
      for (std::uint64_t i = 0; i < shards; ++i) {
        const ShardName name = shard_of("plan", cells, i, shards);
        CHECK(name.first == next);
        CHECK(name.end > name.first);
        CHECK(name.end - name.first <= cells / shards + 1);
        next = name.end;
      }
      CHECK(next == cells);
    }
  }
}

TEST_CASE("a plan that is divided on a full disk says to make room, and leaves nothing") {
  const SmallSweep sweep;
  const std::string mesh = sweep.file("cube.obj");
  const std::uintmax_t size = std::filesystem::file_size(mesh);
  std::filesystem::create_directory(sweep.file("there"));
  for (const char* const name : {"dir", "there"}) {
    for (const std::uintmax_t room : {size / 2, size + 100}) {  // in the first mesh, and later
      Status status;
      {
        const FullDisk full(room);
        status = write_plan_folder(sweep.file(name), sweep.plan(), 2, {});
      }
      REQUIRE(!status);
      CHECK_MESSAGE(status.error().message().find("room") != std::string::npos, status.error().message());
      CHECK(std::filesystem::exists(sweep.file(name)) == (name == std::string("there")));
    }
  }
  CHECK(std::filesystem::is_empty(sweep.file("there")));
  REQUIRE(write_plan_folder(sweep.file("there"), sweep.plan(), 2, {}));
  Plan plan = sweep.plan();
  plan.meshes[0] = sweep.file("none.obj");
  const Status missing = write_plan_folder(sweep.file("dir"), plan, 2, {});
  REQUIRE(!missing);
  CHECK(missing.error().message().find("none.obj: is not there; name a file") != std::string::npos);
  CHECK(!std::filesystem::exists(sweep.file("dir")));
}

TEST_CASE("merging refuses shards that are missing, unfinished or foreign, and a plan that has changed") {
  const SmallSweep sweep;
  const std::string folder = sweep.file("dir");
  REQUIRE(write_plan_folder(folder, sweep.plan(), 2, {}));
  CHECK(!write_plan_folder(folder, sweep.plan(), 2, {}));  // it is not empty
  CHECK(!write_plan_folder(sweep.file("many"), sweep.plan(), 17, {}));
  const PlanFolder divided = *open_plan_folder(folder);
  const auto merged = [&](const char* out) {
    const auto outcome = merge_shards(divided, sweep.file(out), {});
    return outcome ? std::string("merged") : outcome.error().message();
  };
  REQUIRE(run_shard(divided, 0, {}));
  CHECK(merged("a.sqlite").find("shard-000001.jsonl") != std::string::npos);
  CHECK(!std::filesystem::exists(sweep.file("a.sqlite")));

  SweepOptions one;
  bool enough = false;
  one.stop = [&] { return enough; };
  one.progress = [&](const SweepProgress&) { enough = true; };
  REQUIRE(run_shard(divided, 1, one)->stopped);
  CHECK(merged("a.sqlite").find("shard-000001.jsonl: is not finished") != std::string::npos);
  CHECK(!std::filesystem::exists(sweep.file("a.sqlite")));  // nothing of a refused merge stays
  sweep.write("empty.sqlite", "");
  CHECK(merged("empty.sqlite").find("is not finished") != std::string::npos);
  CHECK(std::filesystem::exists(sweep.file("empty.sqlite")));  // but what was there

  std::filesystem::copy_file(divided.shard_file(0), divided.shard_file(1),
                             std::filesystem::copy_options::overwrite_existing);
  CHECK(merged("b.sqlite").find("shard-000001.jsonl: belongs to another") != std::string::npos);
  std::filesystem::remove(divided.shard_file(1));
  REQUIRE(run_shard(divided, 1, {}));
  CHECK(merged("a.sqlite") == "merged");
  CHECK(merged("empty.sqlite") == "merged");  // goes on with what was there
  CHECK(!run_shard(divided, 2, {}));

  std::ofstream(folder + "/inputs/0/cube.obj", std::ios::app) << "# another\n";
  const auto changed = open_plan_folder(folder);
  REQUIRE(!changed);
  CHECK(changed.error().message().find("not those that were divided") != std::string::npos);
}

TEST_CASE("a copy of a mesh that went bad refuses every shard, and is put back by dividing the same plan again") {
  const SmallSweep sweep;
  const std::string dir = sweep.file("dir"), copy = dir + "/inputs/0/cube.obj",
                    whole = bytes_of(sweep.file("cube.obj"));
  const auto put_back = [&](const Plan& plan, std::uint64_t shards) {
    const auto done = put_back_inputs(dir, plan, shards);
    return done ? std::to_string(*done) : done.error().message();
  };
  REQUIRE(write_plan_folder(dir, sweep.plan(), 2, {}));
  REQUIRE(run_shard(*open_plan_folder(dir), 0, {}));
  const std::string shard = bytes_of(open_plan_folder(dir)->shard_file(0));
  CHECK(put_back(sweep.plan(), 2) == "0");
  sweep.write("dir/inputs/0/cube.obj", whole.substr(0, whole.size() / 2));
  std::filesystem::remove(dir + "/inputs/2/walk.csv");
  const auto refused = open_plan_folder(dir);
  REQUIRE(!refused);
  CHECK(refused.error().message().find("are not those that were divided; say sweep plan again") != std::string::npos);
  CHECK(put_back(sweep.plan(), 3).find("in other shards") != std::string::npos);
  Plan other = sweep.plan();
  other.ticks = 7;
  CHECK(put_back(other, 2).find("holds another plan") != std::string::npos);
  CHECK(bytes_of(copy) != whole);  // refusing changes nothing
  CHECK(put_back(sweep.plan(), 2) == "2");
  CHECK(bytes_of(copy) == whole);
  REQUIRE(open_plan_folder(dir));
  CHECK(bytes_of(open_plan_folder(dir)->shard_file(0)) == shard);
}

}  // namespace
}  // namespace tangent::sweep
