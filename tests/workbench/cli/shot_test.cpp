// `workbench shot` as a process: names, sizes, failures.
#ifdef TANGENT_HAS_GUI
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/platform/window_shots.h"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

using namespace tangent;
using namespace tangent::testing;

namespace {

int big_endian(const std::string& bytes, std::size_t at) {
  int value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
  return value;
}

bool no_gl() {
  const auto context = OffscreenContext::open();
  if (!context) MESSAGE("skipped: " << context.error().message());
  return !context;
}

}  // namespace

TEST_CASE("shot lists its views") {
  const ProcessResult list = run_workbench({"shot", "--view", "list"});
  CHECK(list.exit_code == 0);
  for (const char* name : {"overview", "control-net", "iterations", "plots", "cone", "sphere"})
    CHECK(contains(list.out, name));
}

TEST_CASE("shot refuses an unknown view and a missing target, naming the choices") {
  const TempFolder folder;
  const ProcessResult unknown = run_workbench({"shot", "--view", "overwiev", "--out", folder.file("a.png")});
  CHECK(unknown.exit_code == 2);
  CHECK(contains(unknown.err, "overwiev"));
  CHECK(contains(unknown.err, "control-net"));
  CHECK(folder.entry_count() == 0);
  CHECK(run_workbench({"shot", "--view", "cone"}).exit_code == 2);
  CHECK(run_workbench({"shot", "--view", "cone", "--out", folder.file("a.png"), "--width", "nan"}).exit_code == 2);
  CHECK(run_workbench({"shot", "--view", "cone", "--out", folder.file("a.png"), "--height", "0"}).exit_code == 2);
}

TEST_CASE("shot writes a picture of the size asked for, the same every time") {
  if (no_gl()) return;
  const TempFolder folder;
  for (const char* name : {"a.png", "b.png"}) {
    const ProcessResult done =
        run_workbench({"shot", "--view", "octagon", "--out", folder.file(name), "--width", "320", "--height", "200"});
    CHECK(done.exit_code == 0);
    CHECK(done.err == "");
  }
  const std::string picture = read_text(folder.file("a.png"));
  REQUIRE(picture.size() > 5000);  // not one colour
  CHECK(big_endian(picture, 16) == 320);
  CHECK(big_endian(picture, 20) == 200);
  CHECK(picture == read_text(folder.file("b.png")));
}

TEST_CASE("pictures of all views go into a folder that is made, and a file in its place is named") {
  if (no_gl()) return;
  const TempFolder folder;
  const std::string taken = folder.write("taken", "not a folder\n");
  const ProcessResult refused = run_workbench({"shot", "--view", "all", "--out", taken});
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.err, "taken: this folder can't be made"));
  const std::string pictures = folder.file("new/pictures"), first = pictures + "/overview.png";
  const Process shot({"shot", "--view", "all", "--out", pictures, "--width", "64", "--height", "64"});
  while (!std::filesystem::exists(first) && !shot.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  shot.interrupt();  // the others take minutes
  CHECK_FALSE(contains(shot.wait().err, "cannot create"));
  CHECK(std::filesystem::exists(first));
}

TEST_CASE("shot ends on SIGTERM with code 1 and keeps the pictures that are drawn") {
  if (no_gl()) return;
  const TempFolder folder;
  const std::string first = folder.file("pictures/overview.png");
  const Process shot({"shot", "--view", "all", "--out", folder.file("pictures"), "--width", "64", "--height", "64"});
  while (!std::filesystem::exists(first) && !shot.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  shot.interrupt(SIGTERM);
  const ProcessResult ended = shot.wait();
  CHECK(ended.exit_code == 1);
  CHECK(contains(ended.err, "interrupted; " + folder.file("pictures") + " holds "));
  CHECK(std::filesystem::exists(first));
}

TEST_CASE("shot leaves out the ground where asked to, of the scene alone, and its picture says where it comes from") {
  CHECK(run_workbench({"shot", "--view", "overview", "--transparent", "--out", "a.png"}).exit_code == 2);
  if (no_gl()) return;
  const TempFolder folder;
  const ProcessResult done = run_workbench({"shot", "torus", "--view", "normals", "--transparent", "--out",
                                            folder.file("a.png"), "--width", "160", "--height", "120"});
  CHECK(done.exit_code == 0);
  const std::string picture = read_text(folder.file("a.png"));
  CHECK(picture[25] == 6);  // colour and alpha
  for (const char* words : {"torus, ", "workbench shot torus --view normals --width 160", "Tangent Workbench "})
    CHECK(contains(picture, words));
}

TEST_CASE("text and lines of a picture of the scene grow with its height, unless a scale is given") {
  if (no_gl()) return;
  const TempFolder folder;
  const auto shot = [&](const char* name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"shot",    "--view", "octagon",  "--out", folder.file(name),
                                       "--width", "640",    "--height", "1080"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    REQUIRE(run_workbench(arguments).exit_code == 0);
    return read_text(folder.file(name));
  };
  const std::string by_itself = shot("a.png", {});
  CHECK(by_itself == shot("b.png", {"--scale", "1.5"}));
  CHECK(by_itself != shot("c.png", {"--scale", "1"}));
}

TEST_CASE("the window is drawn without a display, plots filled, the same every time") {
  if (no_gl()) return;
  const TempFolder folder;
  for (const char* name : {"a.png", "b.png"}) {
    const ProcessResult done =
        run_workbench({"shot", "--view", "overview", "--out", folder.file(name), "--width", "800", "--height", "600"});
    CHECK(done.exit_code == 0);
    CHECK(done.err == "");
  }
  const std::string picture = read_text(folder.file("a.png"));
  CHECK(picture.size() > 30000);
  CHECK(picture == read_text(folder.file("b.png")));
}

TEST_CASE("the window on two triangles, whose contact never leans as the picture wants it, takes less than 250 MB") {
  if (no_gl()) return;
  const TempFolder folder;
  const std::string plate = folder.write("plate.obj", "v 0 0 0\nv 40 0 0\nv 40 40 0\nv 0 40 0\nf 1 2 3\nf 1 3 4\n");
  const ProcessResult done = run_workbench({"shot", plate, "--view", "overview", "--out", folder.file("a.png")});
  CHECK(done.exit_code == 0);
  MESSAGE("peak " << done.peak_kb / 1000 << " MB");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK(done.peak_kb < 250000);
#endif
}

TEST_CASE("a contact that was never in view is not waited for, one that has left it is, for so long") {
  for (const bool seen : {false, true})
    for (const bool in_view : {false, true}) CHECK(explores_on(11950, seen, in_view));
  CHECK_FALSE(explores_on(12000, false, false));
  CHECK_FALSE(explores_on(12000, true, true));
  CHECK(explores_on(12000, true, false));
  CHECK(explores_on(23950, true, false));
  CHECK_FALSE(explores_on(24000, true, false));
}

TEST_CASE("a script makes pictures without a display, and a line of it that fails is named by its number") {
  if (no_gl()) return;
  const TempFolder folder;
  const std::string script = folder.write("steps.txt", "# a picture for a page\nmethod paper\nrun 200\npicture " +
                                                           folder.file("mine.png") + "\ntheme light\n");
  const ProcessResult done = run_workbench(
      {"shot", "icosphere", "--script", script, "--out", folder.file("end.png"), "--width", "800", "--height", "600"});
  CHECK(done.exit_code == 0);
  CHECK(done.err == "");
  for (const char* name : {"mine.png", "end.png"}) {
    const std::string picture = read_text(folder.file(name));
    REQUIRE(picture.size() > 20000);
    CHECK(big_endian(picture, 16) == 800);
  }
  CHECK(read_text(folder.file("mine.png")) != read_text(folder.file("end.png")));
  const std::string wrong = folder.write("wrong.txt", "method paper\nmethod papper\n");
  const ProcessResult failed = run_workbench({"shot", "--script", wrong, "--out", folder.file("no.png")});
  CHECK(failed.exit_code == 1);
  CHECK(contains(failed.err, "wrong.txt:2"));
  CHECK(contains(failed.err, "choose one of: paper, newton"));
  CHECK_FALSE(std::filesystem::exists(folder.file("no.png")));
  CHECK(run_workbench({"shot", "--script", folder.file("none.txt")}).exit_code == 1);
  CHECK(run_workbench({"shot", "--out", folder.file("no.png")}).exit_code == 2);
  CHECK(run_workbench({"shot", "--view", "cone", "--script", script}).exit_code == 2);
}

TEST_CASE("shot says what a view takes where it would draw something else than the mesh or polygon given") {
  const TempFolder folder;
  const std::string mesh = folder.write("sheet.obj", "v 0 0 0\nv 40 0 0\nv 40 40 0\nf 1 2 3\n");
  const std::string outline = folder.write("outline.csv", "x_m,y_m\n0,0\n0.04,0\n0.04,0.04\n0,0\n");
  const auto refused = [&](const std::string& given, const std::string& view) {
    const ProcessResult done = run_workbench({"shot", given, "--view", view, "--out", folder.file("a.png")});
    CHECK(done.exit_code == 2);
    CHECK(contains(done.err, "the view " + view + " draws "));
    return done.err;
  };
  CHECK(contains(refused(mesh, "planar"), "sheet.obj: the view planar draws a polygon, and this is none"));
  CHECK(contains(refused(mesh, "cone"), "the paper's cone, edges rounded by 1.5 mm, and no mesh"));
  CHECK(contains(refused("torus", "sphere"), "the paper's sphere, and no mesh"));
  CHECK(contains(refused(mesh, "experiment-guide"), "and no mesh; leave the mesh out"));
  for (const char* view : {"planes", "facets", "control-net"})
    CHECK(contains(refused(outline, view), "a mesh, and this is a polygon"));
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("a picture's name ends in .png, or shot refuses it") {
  const TempFolder folder;
  for (const char* name : {"x.jpg", "x", "x.png.svg"}) {
    const ProcessResult done = run_workbench({"shot", "--view", "cone", "--out", folder.file(name)});
    CHECK(done.exit_code == 2);
    CHECK(contains(done.err, std::string(name) + " names no format that is written; end it in .png"));
  }
  CHECK(folder.entry_count() == 0);
  if (no_gl()) return;
  CHECK(run_workbench({"shot", "--view", "cone", "--width", "64", "--height", "64", "--out", folder.file("a.PNG")})
            .exit_code == 0);
  CHECK(run_workbench({"shot", "--view", "cone", "--width", "64", "--height", "64", "--out", "/dev/null"}).exit_code ==
        0);
}

TEST_CASE("gui lists the window's commands without a display") {
  const ProcessResult list = run_workbench({"gui", "--commands"});
  CHECK(list.exit_code == 0);
  CHECK(list.out == read_text(testing::source_folder() + "/workbench/COMMANDS.md"));
}

TEST_CASE("shot says what is wrong with a mesh or a target, and leaves nothing behind") {
  if (no_gl()) return;
  const TempFolder folder;
  const ProcessResult no_mesh =
      run_workbench({"shot", folder.file("none.obj"), "--view", "facets", "--out", folder.file("a.png")});
  CHECK(no_mesh.exit_code == 1);
  CHECK(contains(no_mesh.err, "none.obj"));
  // The window would go on with its built-in scene; a picture of that is not what was asked for.
  const ProcessResult no_window =
      run_workbench({"shot", folder.file("none.obj"), "--view", "overview", "--out", folder.file("a.png")});
  CHECK(no_window.exit_code == 1);
  CHECK(contains(no_window.err, "none.obj"));
  const ProcessResult no_preset = run_workbench(
      {"shot", "--view", "overview", "--preset", folder.file("none.toml"), "--out", folder.file("a.png")});
  CHECK(no_preset.exit_code == 1);
  CHECK(contains(no_preset.err, "none.toml"));
  const ProcessResult no_place = run_workbench({"shot", "--view", "cube", "--out", folder.file("nowhere/a.png")});
  CHECK(no_place.exit_code == 1);
  CHECK(contains(no_place.err, "nowhere"));
  CHECK(folder.entry_count() == 0);
}
#endif
