#include "workbench/sweep/plan_folder.h"

#include "core/io/atomic_file.h"
#include "core/io/input_file.h"
#include "workbench/sweep/plan_digest.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <fstream>

namespace tangent::sweep {
namespace {

namespace fs = std::filesystem;
constexpr int kFolderFormat = 1;
constexpr std::size_t kMaxBytes = std::size_t{1} << 22;

std::string numbered(std::string_view what, std::uint64_t number) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%06llu", static_cast<unsigned long long>(number));
  return std::string(what) + digits.data();
}

tl::unexpected<Error> system_error(const fs::path& path, const std::error_code& error, const char* doing) {
  const bool full = error == std::errc::no_space_on_device;
  return fail(std::string(doing) + ": " + error.message(), path.string(),
              full ? "make room, or choose a folder on another disk" : "choose a folder that may be written");
}

/// Says what is wrong with which of the two, which std::filesystem does not: a full disk is an "input/output error".
Status copy_input(const fs::path& from, const fs::path& to) {
  std::ifstream in(from, std::ios::binary);
  if (!in) return fail("can't be read", from.string(), "name a file that may be read");
  Result<AtomicFile> out = AtomicFile::create(to);
  if (!out) return tl::unexpected(out.error());
  std::string part(std::size_t{1} << 20, '\0');
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())), in.gcount() > 0)
    if (Status ok = out->write({part.data(), static_cast<std::size_t>(in.gcount())}); !ok) return ok;
  if (in.bad()) return fail("can't be read to its end", from.string(), "check the disk that it is on");
  return out->commit();
}

bool same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(a, error);
  if (error || !fs::is_regular_file(b, error) || fs::file_size(b, error) != size || error) return false;
  std::ifstream one(a, std::ios::binary), other(b, std::ios::binary);
  std::string part(std::size_t{1} << 20, '\0'), beside(part.size(), '\0');
  for (;;) {
    one.read(part.data(), static_cast<std::streamsize>(part.size()));
    other.read(beside.data(), static_cast<std::streamsize>(beside.size()));
    if (one.gcount() != other.gcount() || part != beside) return false;
    if (one.gcount() == 0) return true;
  }
}

/// Copies what the plan reads into `inputs`, each into a folder of its own, so that names stay; where they are from the
/// plan's folder, meshes first. What is there already stays; `copied` counts the others.
Result<std::vector<std::string>> copy_inputs(const Plan& plan, const fs::path& inputs, std::size_t& copied) {
  std::vector<std::string> names;
  const auto copy = [&](const fs::path& from) -> Status {
    const fs::path to = fs::path(std::to_string(names.size())) / from.filename();
    std::error_code error;
    fs::create_directories(inputs / to.parent_path(), error);
    if (error) return system_error(inputs / to.parent_path(), error, "can't be made");
    if (!fs::is_regular_file(from, error))
      return fail(fs::exists(from, error) ? "is no file that can be copied" : "is not there", from.string(),
                  "name a file that is there");
    if (!same_bytes(from, inputs / to)) {
      if (Status ok = copy_input(from, inputs / to); !ok) return ok;
      ++copied;
    }
    names.push_back((fs::path("inputs") / to).string());
    return {};
  };
  for (const fs::path& mesh : plan.meshes)
    if (Status ok = copy(mesh); !ok) return tl::unexpected(ok.error());
  for (const std::string& poses : plan.poses) {
    if (is_made(poses)) {
      names.push_back(poses);
    } else if (Status ok = copy(poses); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  return names;
}

/// Minutes for the job's time limit: twice what is expected, 10 at least.
std::uint64_t minutes_of(const JobScripts& scripts) {
  return std::max<std::uint64_t>(10, static_cast<std::uint64_t>(scripts.seconds_a_job / 30.0) + 1);
}

std::string times_option(const JobScripts& scripts) {
  return scripts.times > 0 ? " --times " + std::to_string(scripts.times) : std::string();
}

std::string slurm_script(std::uint64_t shards, const JobScripts& scripts) {
  const std::uint64_t jobs = (shards + scripts.shards_a_job - 1) / scripts.shards_a_job;
  return "#!/bin/sh\n"
         "# All shards as a job array: sbatch slurm.sh, in this folder. Run it again after a failure: what is done\n"
         "# stays done. Then: " +
         scripts.program +
         " sweep merge . --out sweep.sqlite\n"
         "#SBATCH --job-name=tangent-sweep\n"
         "#SBATCH --array=0-" +
         std::to_string(jobs - 1) +
         "\n"
         "#SBATCH --ntasks=1\n"
         "#SBATCH --cpus-per-task=1\n"
         "#SBATCH --time=" +
         std::to_string(minutes_of(scripts)) +
         "\n"
         "#SBATCH --output=job-%a.log\n"
         "first=$((SLURM_ARRAY_TASK_ID * " +
         std::to_string(scripts.shards_a_job) +
         "))\n"
         "last=$((first + " +
         std::to_string(scripts.shards_a_job - 1) +
         "))\n"
         "[ \"$last\" -lt " +
         std::to_string(shards) + " ] || last=" + std::to_string(shards - 1) +
         "\n"
         "for shard in $(seq \"$first\" \"$last\"); do\n"
         "  " +
         scripts.program + " sweep run . --shard \"$shard\" --threads 1" + times_option(scripts) +
         " || exit 1\n"
         "done\n";
}

std::string parallel_script(std::uint64_t shards, const JobScripts& scripts) {
  return "#!/bin/sh\n"
         "# All shards on this machine by GNU parallel: sh parallel.sh, in this folder. Run it again after a failure:\n"
         "# what is done stays done. Then: " +
         scripts.program +
         " sweep merge . --out sweep.sqlite\n"
         "seq 0 " +
         std::to_string(shards - 1) + " | parallel --will-cite --halt now,fail=1 " + scripts.program +
         " sweep run . --shard {} --threads 1" + times_option(scripts) + "\n";
}

}  // namespace

fs::path PlanFolder::shard_file(std::uint64_t shard) const {
  return folder / "shards" / (numbered("shard-", shard) + ".jsonl");
}

namespace {

/// Into a folder that is not there, or is empty.
Status fill_folder(const fs::path& folder, const Plan& plan, const Cells& cells, std::uint64_t shards,
                   const JobScripts& scripts) {
  std::error_code error;
  for (const char* name : {"inputs", "shards"}) {
    fs::create_directories(folder / name, error);
    if (error) return system_error(folder / name, error, "can't be made");
  }
  std::size_t written = 0;
  const Result<std::vector<std::string>> names = copy_inputs(plan, folder / "inputs", written);
  if (!names) return tl::unexpected(names.error());
  if (Status ok = write_file_atomic(folder / "plan.toml", format_plan(plan, *names)); !ok) return ok;
  const Result<Plan> copied = read_plan(folder / "plan.toml");
  if (!copied) return tl::unexpected(copied.error());
  if (Status ok = write_file_atomic(folder / "slurm.sh", slurm_script(shards, scripts)); !ok) return ok;
  if (Status ok = write_file_atomic(folder / "parallel.sh", parallel_script(shards, scripts)); !ok) return ok;
  nlohmann::ordered_json json{
      {"format", kFolderFormat}, {"plan", plan_digest(*copied)}, {"cells", cells.size()}, {"shards", shards}};
  if (scripts.times > 0) json["times"] = scripts.times;
  return write_file_atomic(folder / "plan.json", json.dump(2) + "\n");
}

/// What fill_folder made; the folder itself where it was not there before.
void empty_folder(const fs::path& folder, bool was_there) {
  std::error_code ignored;
  for (const char* const name : {"inputs", "shards", "plan.toml", "slurm.sh", "parallel.sh", "plan.json"})
    fs::remove_all(folder / name, ignored);
  if (!was_there) fs::remove(folder, ignored);
}

}  // namespace

Status check_shards(std::uint64_t shards, const Cells& cells) {
  if (shards > 0 && shards <= cells.size()) return {};
  return fail(
      std::to_string(shards) + " shards for " + std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells"),
      "--shards", "allowed: 1 to the number of cells");
}

Status write_plan_folder(const fs::path& folder, const Plan& plan, std::uint64_t shards, const JobScripts& scripts) {
  const Result<Cells> cells = Cells::of(plan);
  if (!cells) return tl::unexpected(cells.error());
  if (Status ok = check_shards(shards, *cells); !ok) return ok;
  std::error_code error;
  const bool there = fs::exists(folder, error);
  if (there && !fs::is_directory(folder, error)) return fail("is a file", folder.string(), "name a new folder");
  if (there && !fs::is_empty(folder, error)) return fail("is not empty", folder.string(), "name a new folder");
  Status filled = fill_folder(folder, plan, *cells, shards, scripts);
  if (!filled) empty_folder(folder, there);
  return filled;
}

namespace {

/// What plan.json says.
struct Divided {
  std::string digest;
  std::uint64_t cells = 0, shards = 0, times = 0;
};

Result<Divided> read_divided(const fs::path& folder) {
  const fs::path file = folder / "plan.json";
  const Result<std::string> text = read_input_file(file, kMaxBytes);
  if (!text) return tl::unexpected(text.error());
  const auto json = nlohmann::ordered_json::parse(*text, nullptr, false);
  const auto whole = [&](const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_number_unsigned() ? json[key].get<std::uint64_t>()
                                                                                    : 0;
  };
  if (whole("format") > kFolderFormat) return fail("is of a newer program", file.string(), "use that program");
  const bool named = json.is_object() && json.contains("plan") && json["plan"].is_string();
  if (whole("format") != kFolderFormat || !named || whole("cells") == 0 || whole("shards") == 0)
    return fail("is no divided plan", file.string(), "make one: workbench sweep plan PLAN.toml --out DIR --shards N");
  return Divided{json["plan"].get<std::string>(), whole("cells"), whole("shards"), whole("times")};
}

}  // namespace

Result<std::size_t> put_back_inputs(const fs::path& folder, const Plan& plan, std::uint64_t shards) {
  const Result<Divided> divided = read_divided(folder);
  if (!divided) return tl::unexpected(divided.error());
  if (divided->digest != plan_digest(plan) || divided->shards != shards)
    return fail("holds another plan, or one in other shards (or its meshes or poses have changed since)",
                folder.string(), "name a new folder");
  std::size_t copied = 0;
  const Result<std::vector<std::string>> names = copy_inputs(plan, folder / "inputs", copied);
  if (!names) return tl::unexpected(names.error());
  if (Status ok = write_file_atomic(folder / "plan.toml", format_plan(plan, *names)); !ok)
    return tl::unexpected(ok.error());
  return copied;
}

Result<PlanFolder> open_plan_folder(const fs::path& folder) {
  const Result<Divided> divided = read_divided(folder);
  if (!divided) return tl::unexpected(divided.error());
  Result<Plan> plan = read_plan(folder / "plan.toml");
  if (!plan) return tl::unexpected(plan.error());
  PlanFolder out{folder, std::move(*plan), divided->digest, divided->cells, divided->shards, divided->times};
  const Result<Cells> cells = Cells::of(out.plan);
  if (!cells) return tl::unexpected(cells.error());
  if (cells->size() != out.cells || plan_digest(out.plan) != out.digest)
    return fail("plan, meshes or poses are not those that were divided", folder.string(),
                "say sweep plan again, with the same plan, --out and --shards: it puts them back");
  return out;
}

}  // namespace tangent::sweep
