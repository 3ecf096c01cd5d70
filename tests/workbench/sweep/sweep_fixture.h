// A small sweep over generated meshes, on disk.
#pragma once

#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "tests/support/full_disk.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "workbench/sweep/plan_digest.h"
#include "workbench/sweep/sweep_run.h"

#include <doctest/doctest.h>

#include <fstream>
#include <string>
#include <vector>

namespace tangent::sweep::testing {

using tangent::testing::FullDisk;

class SmallSweep {
 public:
  static constexpr int kTicks = tangent::testing::kSanitized ? 100 : 600;  ///< of its motion

  explicit SmallSweep(const std::string& more = "") {
    for (const char* name : {"cube", "torus"})
      REQUIRE(write_obj(*generate_mesh(name), file(name + std::string(".obj")), 1e-3));
    write("walk.csv", poses());
    write("plan.toml",
          "[plan]\nmeshes = [\"cube.obj\", \"torus.obj\"]\nposes = [\"walk.csv\"]\n"
          "methods = [\"paper\", \"facet\"]\n" +
              more + "[ranges]\n\"solver.gain_curvature_m\" = [0.0, 0.02]\n\"force.blend\" = [\"off\", \"events\"]\n");
  }

  std::string file(const std::string& name) const { return folder_.file(name); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
  Plan plan() const {
    Result<Plan> plan = read_plan(file("plan.toml"));
    REQUIRE_MESSAGE(plan, plan.error().message());
    return *plan;
  }
  Cells cells() const { return *Cells::of(plan()); }

  /// Rows of table cells, as text.
  std::vector<std::string> rows(const std::string& name) const {
    Result<Database> database = Database::open(file(name));
    REQUIRE_MESSAGE(database, database.error().message());
    Result<Statement> statement = database->prepare("SELECT * FROM cells ORDER BY cell");
    REQUIRE(statement);
    std::vector<std::string> out;
    const int columns = 5 + 2 + static_cast<int>(number_columns().size()) + 1;
    while (*statement->step()) {
      std::string& row = out.emplace_back();
      for (int c = 0; c < columns; ++c) row += statement->text(c) + "|";
    }
    return out;
  }

  SweepOutcome solve(const std::string& out, const SweepOptions& options = {}) const {
    const Cells all = cells();
    Result<ResultsFile> results = ResultsFile::open(file(out), all, plan_digest(all.plan()));
    REQUIRE_MESSAGE(results, results.error().message());
    const Result<SweepOutcome> outcome = run_sweep(all, *results, options);
    REQUIRE_MESSAGE(outcome, outcome.error().message());
    REQUIRE(results->finish());
    return *outcome;
  }

 private:
  /// Slides over both meshes.
  static std::string poses() {
    std::string out = "t_s,x_m,y_m,z_m\n";
    for (int i = 0; i < kTicks; ++i) {
      const double x = -0.03 + 0.06 / kTicks * i;
      out += std::to_string(1e-3 * i) + "," + std::to_string(x) + ",0.001,0.055\n";
    }
    return out;
  }

  tangent::testing::TempFolder folder_;
};

inline std::string bytes_of(const std::string& path) { return tangent::testing::read_text(path); }

}  // namespace tangent::sweep::testing
