#include "workbench/embed/batch.h"

#include "core/lab/objects/generate.h"

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

using namespace tangent;

namespace {

std::shared_ptr<const ContactScene> torus() {
  auto scene = ContactScene::build(*ContactMesh::build(*generate_mesh("torus")));
  REQUIRE(scene);
  return *scene;
}

}  // namespace

TEST_CASE("every finger is taken once, however many threads and fingers there are") {
  const auto scene = torus();
  for (const std::size_t fingers : {0, 1, 2, 7, 500})
    for (const unsigned threads : {0u, 1u, 3u, 100u}) {
      std::vector<std::atomic<int>> taken(fingers);
      for_each_finger(scene, fingers, threads, [&](Stepper&, std::size_t finger) { ++taken[finger]; });
      for (const auto& times : taken) CHECK(times == 1);
    }
}

TEST_CASE("what one finger's work throws is thrown to the caller, after the threads have ended") {
  const auto scene = torus();
  const auto work = [](Stepper&, std::size_t finger) {
    if (finger == 3) throw std::runtime_error("third");
  };
  for (const unsigned threads : {1u, 4u}) CHECK_THROWS_WITH(for_each_finger(scene, 100, threads, work), "third");
}

TEST_CASE("where every finger's work throws, one of them is thrown, and millions of threads are not made") {
  const auto scene = torus();
  const auto work = [](Stepper&, std::size_t) { throw std::runtime_error("each"); };
  CHECK_THROWS_WITH(for_each_finger(scene, 1'000'000, 4'000'000'000u, work), "each");
}

TEST_CASE("ticks of many fingers are those of one stepper for each") {
  const auto scene = torus();
  constexpr std::size_t kFingers = 12, kTicks = 5;
  std::vector<TickInput> inputs(kFingers * kTicks);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    inputs[i].t_s = 1e-3 * static_cast<double>(i % kTicks);
    inputs[i].finger.position = {3e-3 * static_cast<double>(i / kTicks), 1e-4 * static_cast<double>(i % kTicks), 0.03};
  }
  std::vector<TickOutput> outputs(inputs.size());
  solve_fingers(scene, Preset{}, inputs, outputs, kFingers, 3);
  int touching = 0;
  for (std::size_t f = 0; f < kFingers; ++f) {
    Stepper stepper(scene);
    TickState state;
    for (std::size_t i = f * kTicks; i < (f + 1) * kTicks; ++i) {
      const TickOutput alone = stepper.step(Preset{}, inputs[i], state);
      CHECK(outputs[i].contact == alone.contact);
      CHECK(outputs[i].force_n == alone.force_n);
      CHECK(outputs[i].iterations == alone.iterations);
      touching += alone.penetration_m > 0.0;
    }
  }
  CHECK(touching > 5);
}
