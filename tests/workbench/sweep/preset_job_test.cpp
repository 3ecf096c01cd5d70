#include "workbench/sweep/preset_job.h"

#include "tests/workbench/sweep/ground_fixture.h"

#include <map>

namespace tangent::sweep {
namespace {

using testing::paper_preset;
using testing::torus_ground;

std::vector<Preset> some_presets(std::size_t count) {
  std::vector<Preset> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(paper_preset(0.003 * static_cast<double>(i)));
  return out;
}

TEST_CASE("presets in the background are cells of a sweep, the same in any number of threads, each once") {
  const Ground ground = torus_ground(150);
  const std::vector<Preset> presets = some_presets(9);
  for (const unsigned threads : {0u, 1u, 3u}) {
    PresetJob job;
    job.start(ground, presets, threads);
    std::map<std::size_t, CellNumbers> found;
    std::size_t taken = 0;
    for (bool more = true; more;) {
      more = job.running();
      for (const PresetJob::Measured& done : job.take()) found[done.index] = done.numbers, ++taken;
      std::this_thread::yield();
    }
    CHECK(taken == presets.size());
    CHECK(job.done() == presets.size());
    for (std::size_t i = 0; i < presets.size(); ++i) {
      Stepper stepper(ground.scene), exact(ground.scene);
      CHECK(found[i] == *measure_cell(stepper, exact, presets[i], *ground.motion));
    }
  }
}

TEST_CASE("presets that are cancelled stop, what was taken stays taken, and others can be started") {
  PresetJob job;
  job.start(torus_ground(4000), some_presets(60), 2);
  job.cancel();
  CHECK_FALSE(job.running());
  job.start(torus_ground(50), some_presets(3), 0);
  CHECK(job.take().size() == 3);
  CHECK_FALSE(job.running());
}

}  // namespace
}  // namespace tangent::sweep
