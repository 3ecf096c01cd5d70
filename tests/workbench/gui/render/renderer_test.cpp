#include "workbench/gui/render/scene_renderer.h"

#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/render/shader_program.h"
#include "workbench/gui/render/staged_scene.h"

#include <doctest/doctest.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <set>
#include <string>

using namespace tangent;
using namespace tangent::testing;

namespace {

constexpr int kImageWidth = 480, kImageHeight = 360;

/// Skips the test, with a message, where there is no off-screen GL.
#define REQUIRE_GL(context)                            \
  const auto context = OffscreenContext::open();       \
  if (!context) {                                      \
    MESSAGE("skipped: " << context.error().message()); \
    return;                                            \
  }

std::shared_ptr<const ContactScene> scene_of(PolygonMesh mesh) {
  return ContactScene::build(ContactMesh::build(mesh).value()).value();
}

PolygonMesh placed(PolygonMesh mesh, double scale, const Vec3& offset) {
  for (Vec3& p : mesh.positions) p = scale * p + offset;
  return mesh;
}

Image texture_image(const SceneRenderer& renderer) {
  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, renderer.texture(), 0);
  Image image = read_pixels(framebuffer, renderer.width_px(), renderer.height_px());
  glDeleteFramebuffers(1, &framebuffer);
  return image;
}

/// The staged scene, seen whole, as a picture.
Image picture_of(SceneRenderer& renderer, const StagedScene& staged, const SceneToggles& toggles,
                 Camera* used = nullptr) {
  renderer.set_scene(staged.scene, NormalForm::bernstein);
  renderer.wait_for_tessellation();
  Camera camera;
  Box box = world_bounds(*staged.scene);
  box.include(staged.tick.input.finger.position);
  camera.frame(box);
  const SceneFrame frame = staged.frame(toggles, Theme::dark);
  REQUIRE(renderer.render(frame, camera, kImageWidth, kImageHeight));
  CHECK(glGetError() == GL_NO_ERROR);
  if (used != nullptr) *used = camera;
  return texture_image(renderer);
}

Staging staging_for(double scale) {
  Staging staging;
  staging.preset.finger.radius_m = 0.015 * scale;
  staging.press_m = 1e-3 * scale;
  staging.slide_m = 0.0;
  return staging;
}

double differing_share(const Image& a, const Image& b, int tolerance) {
  REQUIRE(a.rgba.size() == b.rgba.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(int(a.rgba[i + k]) - int(b.rgba[i + k])));
    if (most > tolerance) ++differing;
  }
  return static_cast<double>(differing) / (static_cast<double>(a.rgba.size()) / 4.0);
}

std::size_t distinct_colours(const Image& image) {
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    colours.insert(image.rgba[i] | (std::uint32_t{image.rgba[i + 1]} << 8) | (std::uint32_t{image.rgba[i + 2]} << 16));
  }
  return colours.size();
}

}  // namespace

TEST_CASE("the picture holds mesh, finger and force where the camera projects them") {
  REQUIRE_GL(context);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  const StagedScene staged = stage_finger(scene_of(make_icosphere(0.040, 2)), staging_for(1.0));
  REQUIRE(staged.tick.output.penetration_m > 0.0);
  SceneToggles toggles;
  toggles.control_net = toggles.planes = toggles.penetration = false;
  Camera camera;
  const Image with = picture_of(renderer, staged, toggles, &camera);
  toggles.finger = toggles.force = false;
  const Image without = picture_of(renderer, staged, toggles);
  CHECK(distinct_colours(without) > 200);

  const auto pixel = [&](const Image& image, const Vec3& world) {
    const Vec3 p = camera.project(world, kImageWidth, kImageHeight);
    return image.at(static_cast<int>(p.x), static_cast<int>(p.y));
  };
  // Beside the arrow the finger's skin tints what is behind it: more red than blue, which the view has not.
  const Vec3 beside = staged.tick.input.finger.position + 0.006 * camera.right() + 0.004 * camera.up();
  CHECK(pixel(with, beside)[0] > pixel(without, beside)[0] + 8);
  CHECK(pixel(with, beside)[0] > pixel(with, beside)[2]);
  // Half-way up the arrow: the force's orange, seen through the finger.
  const TickOutput& output = staged.tick.output;
  const Vec3 middle = output.contact + 0.4 * renderer.force_metres_per_newton() * output.force_n;
  const std::uint8_t* arrow = pixel(with, middle);
  CHECK(arrow[0] > arrow[2] + 60);
  // The mesh's centre: a lit grey, not the background.
  const std::uint8_t* mesh = pixel(without, Vec3(0.0));
  CHECK(mesh[0] > 70);
  CHECK(mesh[0] != without.at(3, kImageHeight / 2)[0]);
}

TEST_CASE("a micrometre and a kilometre body, near and far from the origin, make the same picture") {
  REQUIRE_GL(context);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  SceneToggles toggles;
  toggles.smooth_surface = true;
  const PolygonMesh sphere = make_icosphere(0.040, 2);
  const Image reference = picture_of(renderer, stage_finger(scene_of(sphere), staging_for(1.0)), toggles);
  struct Copy {
    double scale;
    Vec3 offset;
  };
  // The converged tolerance of 1 um is physical: the small body's contact may lie a pixel elsewhere.
  for (const Copy& copy :
       {Copy{1e-3, Vec3(0.0)}, Copy{12.5e-6, Vec3(0.0)}, Copy{25e3, Vec3(0.0)}, Copy{1.0, Vec3(1000.0, 0, -300.0)}}) {
    CAPTURE(copy.scale);
    const auto scene = scene_of(placed(sphere, copy.scale, copy.offset));
    SceneToggles mesh_alone = toggles;
    mesh_alone.finger = mesh_alone.force = mesh_alone.planes = mesh_alone.contact = false;
    mesh_alone.penetration = mesh_alone.control_net = false;
    const Image alone = picture_of(renderer, stage_finger(scene_of(sphere), staging_for(1.0)), mesh_alone);
    const Image copied = picture_of(renderer, stage_finger(scene, staging_for(copy.scale)), mesh_alone);
    CHECK(differing_share(alone, copied, 24) < 0.005);
    if (copy.scale >= 1e-3) {
      const StagedScene staged = stage_finger(scene, staging_for(copy.scale));
      CHECK(differing_share(reference, picture_of(renderer, staged, toggles), 40) < 0.02);
    }
  }
}

TEST_CASE("one triangle, open all round, is drawn") {
  REQUIRE_GL(context);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  PolygonMesh one;
  one.positions = {{0, 0, 0}, {0.05, 0, 0}, {0, 0.05, 0}};
  one.add_face({0, 1, 2});
  const StagedScene staged = stage_finger(scene_of(one), staging_for(1.0));
  SceneToggles toggles;
  toggles.smooth_surface = toggles.vertex_normals = toggles.control_net_neighbours = toggles.control_normals = true;
  toggles.control_point_labels = true;
  CHECK(distinct_colours(picture_of(renderer, staged, toggles)) > 200);
  CHECK(renderer.tessellation_triangles() == 64 * 64);
  std::set<std::string> names;
  for (const SceneLabel& label : renderer.labels()) names.insert(label.text);
  for (const char* name : {"b300", "b030", "b003", "b210", "b120", "b021", "b012", "b102", "b201", "b111", "n110"}) {
    CHECK(names.count(name) == 1);
  }
}

TEST_CASE("the same call makes the same picture, whatever was drawn before") {
  REQUIRE_GL(context);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  const StagedScene sphere = stage_finger(scene_of(make_icosphere(0.040, 2)), staging_for(1.0));
  const StagedScene torus = stage_finger(scene_of(make_torus(0.040, 0.015, 24, 12)), staging_for(0.5));
  const Image first = picture_of(renderer, sphere, {});
  picture_of(renderer, torus, {});
  CHECK(picture_of(renderer, sphere, {}).rgba == first.rgba);
  SceneRenderer other;
  REQUIRE(other.init());
  CHECK(picture_of(other, sphere, {}).rgba == first.rgba);
}

TEST_CASE("a moving camera gets a picture at once and a better one when it rests") {
  REQUIRE_GL(context);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  const StagedScene staged = stage_finger(scene_of(make_icosphere(0.040, 2)), staging_for(1.0));
  renderer.set_scene(staged.scene, NormalForm::bernstein);
  renderer.wait_for_tessellation();
  SceneFrame frame = staged.frame({}, Theme::dark);
  frame.quality = RenderQuality::automatic;
  Camera camera;
  camera.frame(world_bounds(*staged.scene));
  for (int i = 0; i < 3; ++i) {
    camera.orbit(0.01, 0.0);
    REQUIRE(renderer.render(frame, camera, kImageWidth, kImageHeight));
    CHECK(renderer.refining());
  }
  const Image moving = texture_image(renderer);
  for (int i = 0; i < 5; ++i) REQUIRE(renderer.render(frame, camera, kImageWidth, kImageHeight));
  CHECK_FALSE(renderer.refining());
  const Image resting = texture_image(renderer);
  CHECK(differing_share(moving, resting, 60) < 0.05);  // the same view
  CHECK(moving.rgba != resting.rgba);                  // with smoother edges
}

TEST_CASE("a scanned mesh of 69,451 triangles orbits with its smooth surface - the rate is reported") {
  REQUIRE_GL(context);
  if (!shared_files_there({"meshes/stanford-bunny.obj"})) return;
  const std::filesystem::path bunny = shared_file("meshes/stanford-bunny.obj");
  ContactMeshOptions options;
  options.fit_m = 0.080;
  const auto scene = ContactScene::build(ContactMesh::build(read_mesh(bunny, 1e-3).value(), options).value()).value();
  const StagedScene staged = stage_finger(scene, staging_for(1.0));
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  renderer.set_scene(scene, NormalForm::bernstein);
  renderer.wait_for_tessellation();
  CHECK(renderer.tessellation_triangles() == 0);  // not uploaded yet
  SceneFrame frame = staged.frame({}, Theme::dark);
  frame.toggles.smooth_surface = true;
  frame.quality = RenderQuality::automatic;
  Camera camera;
  camera.y_up = true;
  camera.frame(world_bounds(*scene));
  for (int i = 0; i < 12; ++i) REQUIRE(renderer.render(frame, camera, 1280, 720));
  CHECK(renderer.tessellation_triangles() > 2 * scene->mesh().usable_triangle_count());
  CHECK(renderer.tessellation_triangles() <= 300'000);
  const auto rate = [&](int frames, double turn_rad) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t begin_cpu = std::clock();
    for (int i = 0; i < frames; ++i) {
      camera.orbit(turn_rad, 0.0);
      REQUIRE(renderer.render(frame, camera, 1280, 720));
      glFinish();
    }
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double processor = static_cast<double>(std::clock() - begin_cpu) / CLOCKS_PER_SEC;
    return std::to_string(frames / wall) + " frames/s, " + std::to_string(1e3 * processor / frames) +
           " ms of processor time each";
  };
  const std::string moving = rate(30, 0.02), resting = rate(30, 0.0);
  const std::string driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  MESSAGE("1280 x 720 on " << driver << ": orbiting " << moving << "; camera at rest " << resting);
  CHECK(distinct_colours(texture_image(renderer)) > 1000);
}

TEST_CASE("nothing to draw is no failure: no scene, no tick, no pixels") {
  REQUIRE_GL(context);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  const Camera camera;
  CHECK_FALSE(renderer.render({}, camera, 0, 100));
  CHECK(renderer.render({}, camera, 64, 64));
  CHECK(renderer.tessellation_progress() == 1.0f);
  CHECK_FALSE(texture_image(renderer).rgba.empty());
  const auto scene = scene_of(make_icosphere(0.040, 1));
  renderer.set_scene(scene, NormalForm::bernstein);
  CHECK(renderer.render({}, camera, 64, 64));
  renderer.set_scene(nullptr, NormalForm::bernstein);
  CHECK(renderer.render({}, camera, 64, 64));
  CHECK(glGetError() == GL_NO_ERROR);
}

TEST_CASE("the renderer leaves the caller's framebuffer and viewport as they were") {
  REQUIRE_GL(context);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  glViewport(3, 4, 55, 66);
  REQUIRE(renderer.render({}, Camera{}, 64, 64));
  GLint viewport[4] = {}, framebuffer = -1;
  glGetIntegerv(GL_VIEWPORT, viewport);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  CHECK(viewport[0] == 3);
  CHECK(viewport[3] == 66);
  CHECK(framebuffer == 0);
}

TEST_CASE("a shader that does not compile is reported with its file and line, in an included file too") {
  REQUIRE_GL(context);
  const TempFolder folder;
  folder.write("good.vert.glsl", "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n");
  folder.write("good.frag.glsl", "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n");
  CHECK(ShaderProgram::load(folder.path(), "good"));

  folder.write("bad.vert.glsl", "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n");
  folder.write("bad.frag.glsl", "#version 330 core\nout vec4 c;\n\nvoid main() { c = nothing; }\n");
  const auto bad = ShaderProgram::load(folder.path(), "bad");
  REQUIRE_FALSE(bad);
  CHECK(contains(bad.error().where, "bad.frag.glsl:4"));
  CHECK(contains(bad.error().what, "nothing"));

  folder.write("part.glsl", "float half_of(float x) {\n  return x * missing;\n}\n");
  folder.write("uses.vert.glsl", "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n");
  folder.write("uses.frag.glsl",
               "#version 330 core\n#include \"part.glsl\"\nout vec4 c;\nvoid main() { c = vec4(half_of(1.0)); }\n");
  const auto included = ShaderProgram::load(folder.path(), "uses");
  REQUIRE_FALSE(included);
  CAPTURE(included.error().message());
  CHECK(contains(included.error().where, "part.glsl:2"));

  const auto missing = ShaderProgram::load(folder.path(), "absent");
  REQUIRE_FALSE(missing);
  CHECK(contains(missing.error().where, "absent.vert.glsl"));
}

TEST_CASE("a changed shader is loaded again - one with a mistake leaves the last good one in use") {
  REQUIRE_GL(context);
  const TempFolder folder;
  folder.write("live.vert.glsl", "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n");
  const std::string fragment =
      folder.write("live.frag.glsl", "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n");
  auto program = ShaderProgram::load(folder.path(), "live");
  REQUIRE(program);
  const unsigned first = program->id();
  const auto touch = [&](std::string_view text, int seconds) {
    folder.write("live.frag.glsl", text);
    std::filesystem::last_write_time(fragment,
                                     std::filesystem::last_write_time(fragment) + std::chrono::seconds(seconds));
  };
  CHECK(program->reload_if_changed());
  CHECK(program->id() == first);
  touch("#version 330 core\nout vec4 c;\nvoid main() { c = oops; }\n", 10);
  const Status failed = program->reload_if_changed();
  REQUIRE_FALSE(failed);
  CHECK(contains(failed.error().where, "live.frag.glsl:3"));
  CHECK(program->id() == first);
  CHECK(program->reload_if_changed());  // not tried again until it changes
  touch("#version 330 core\nout vec4 c;\nvoid main() { c = vec4(0.5); }\n", 20);
  CHECK(program->reload_if_changed());
  CHECK(program->id() != first);
}

TEST_CASE("a picture is written whole, with its size, or not at all") {
  const TempFolder folder;
  Image image{7, 5, std::vector<std::uint8_t>(7 * 5 * 4, 90)};
  const std::string file = folder.file("a.png");
  REQUIRE(write_png(image, file));
  const std::string bytes = read_text(file);
  REQUIRE(bytes.size() > 33);
  CHECK(bytes.substr(1, 3) == "PNG");
  CHECK(bytes[19] == 7);
  CHECK(bytes[23] == 5);
  CHECK_FALSE(write_png(image, folder.file("nowhere/a.png")));
  CHECK(folder.entry_count() == 1);
}

// Slow to build; run it with: test_workbench_gui -tc="*five million*" --no-skip
TEST_CASE("five million triangles: orbiting, coming to rest and picking are reported" * doctest::skip()) {
  REQUIRE_GL(context);
  const auto scene = scene_of(make_icosphere(0.040, 9));
  REQUIRE(scene->mesh().usable_triangle_count() == 5'242'880);
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  renderer.set_scene(scene, NormalForm::bernstein);
  renderer.wait_for_tessellation();
  SceneFrame frame;
  frame.toggles.control_net = frame.toggles.planes = false;
  Camera camera;
  camera.frame(world_bounds(*scene));
  const auto timed = [&](auto&& what) {
    const auto begin = std::chrono::steady_clock::now();
    what();
    glFinish();
    return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  double longest_upload = 0.0;
  for (int i = 0; i < 400 && renderer.refining(); ++i)
    longest_upload = std::max(longest_upload, timed([&] { renderer.render(frame, camera, 1280, 720); }));
  std::vector<double> moving, resting;
  for (int i = 0; i < 60; ++i) {
    camera.orbit(0.02, 0.0);
    moving.push_back(timed([&] { renderer.render(frame, camera, 1280, 720); }));
  }
  for (int i = 0; i < 400 && (i < 4 || renderer.refining()); ++i)
    resting.push_back(timed([&] { renderer.render(frame, camera, 1280, 720); }));
  CHECK_FALSE(renderer.refining());
  std::vector<double> picks;
  std::size_t hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 pixel(200.0 + 37.0 * (i % 24), 100.0 + 11.0 * (i % 47));
    picks.push_back(timed([&] { hits += pick_triangle(*scene, camera, pixel, 1280, 720) ? 1 : 0; }));
  }
  CHECK(hits > 300);
  std::sort(moving.begin(), moving.end());
  std::sort(picks.begin(), picks.end());
  const double at_rest = *std::max_element(resting.begin(), resting.end());
  MESSAGE("1280 x 720 on " << std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) << ": orbiting "
                           << moving[moving.size() / 2] << " ms a frame (median), " << moving.back()
                           << " worst; to the full picture at rest " << resting.size() << " frames, longest " << at_rest
                           << " ms; longest frame while loading " << longest_upload << " ms; picking "
                           << picks[picks.size() / 2] << " ms median, " << picks.back() << " worst");
}
