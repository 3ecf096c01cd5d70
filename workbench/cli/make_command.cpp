// workbench make: the paper's objects and the hard cases as OBJ, and the 2D arc of its first experiment.
#include "core/io/mesh_io.h"
#include "core/io/polygon_io.h"
#include "core/lab/objects/arc.h"
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generate_hard.h"
#include "workbench/cli/command.h"
#include "workbench/cli/count_text.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"
#include "workbench/evidence/made_mesh.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <memory>
#include <optional>

namespace tangent {
namespace {

constexpr std::array<std::string_view, 2> kFacings{"left", "right"};            // order of Facing
constexpr std::array<std::string_view, 2> kPlacements{"tangent", "inscribed"};  // order of ArcPlacement
constexpr std::string_view kArc = "arc";

struct MakeOptions {
  std::string object;
  GenerateOptions generate;
  std::filesystem::path file;
  double metres_per_unit = kMillimetre;
  std::optional<ArcPlacement> placement;
  bool exact = false;
};

int refuse(const std::string& why) {
  print_message("make", why);
  return kUsage;  // the object or its options do not exist
}

int written(const MakeOptions& options, const Status& status, const std::string& what) {
  if (!status) {
    print_message("make", status.error().message());
    return kFailed;
  }
  std::fputs((options.file.string() + ": " + what + "\n").c_str(), stdout);
  return kDone;
}

/// One further facet at either end, so that whole patches cover the arc itself.
int make_arc(const MakeOptions& options) {
  constexpr int kDefaultSegments = 5, kMostSegments = 10000;
  const int segments = options.generate.segments == 0 ? kDefaultSegments : options.generate.segments;
  if (options.generate.rounding_m != 0.0) return refuse("arc has no edges to round; leave out --rounding-mm");
  if (options.exact) {
    if (options.generate.segments != 0 || options.placement)
      return refuse("an exact arc has no segments; leave --segments and --placement out");
    return written(options, write_polygon(ArcStimulus{}.exact(), options.file, options.metres_per_unit),
                   format("a circle of %g mm radius over %g rad, and straight ends; 64 segments for other programs",
                          kPaperArcRadius / kMillimetre, kPaperArcRad));
  }
  if (segments < 2 || segments > kMostSegments) return refuse("arc takes 2 to 10000 --segments");
  const PlanarPolygon arc = make_paper_arc(segments, options.placement.value_or(ArcPlacement::tangent));
  return written(options, write_polygon(arc, options.file, options.metres_per_unit),
                 format("%s and one more at either end, %g rad of a circle of %g mm radius", arc.name.c_str(),
                        kPaperArcRad, kPaperArcRadius / kMillimetre));
}

/// Whether the name says a format that is written; a device or a pipe needs none.
bool has_format(const MakeOptions& options) {
  std::error_code error;
  if (std::filesystem::exists(options.file, error) && !std::filesystem::is_regular_file(options.file, error))
    return true;
  std::string ending = options.file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".obj" || (ending == ".csv" && options.object == kArc);
}

int run_make(const MakeOptions& options) {
  if (!has_format(options))
    refuse_option("--out", options.file.string() + " names no format that is written; end it in .obj" +
                               (options.object == kArc ? " or .csv" : ""));
  if (options.object == kArc) return make_arc(options);
  if (options.placement) return refuse("--placement is of arc; leave it out");
  if (options.exact) return refuse("--exact is of arc; leave it out");
  const Result<PolygonMesh> mesh = generate_mesh(options.object, options.generate);
  if (!mesh) return refuse(mesh.error().message());
  return written(options,
                 write_obj(*mesh, options.file, options.metres_per_unit,
                           "workbench " + made_text({options.object, options.generate})),
                 options.object + ", " + count_text(mesh->positions.size(), "vertex", "vertices") + ", " +
                     count_text(mesh->face_count(), "face", "faces"));
}

}  // namespace

void add_make_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "make", "Write one of the paper's objects or a hard case");
  auto options = std::make_shared<MakeOptions>();
  std::string names;
  for (const std::string& name : generator_names()) names += (names.empty() ? "" : " ") + name;
  names += "; in 2D: arc; hard cases:";
  for (const std::string& name : hard_mesh_names()) names += " " + name;
  add_text_option(*command, "OBJECT", options->object, names, "", Needed::yes);
  add_text_option(*command, "--out", options->file, "File to write; of the arc also .csv, in metres", "F.obj",
                  Needed::yes);
  add_number_option(
      *command, "--segments", {.min = 1, .max = 100000, .whole = true},
      "Around a round object, subdivisions of an icosphere, lines of a grid, facets of the arc (default: the "
      "object's own)",
      [options = options.get()](double n) { options->generate.segments = static_cast<int>(n); });
  add_number_option(*command, "--rounding-mm", {.min = 0.0, .max = 1000.0, .unit = "mm"},
                    "Radius of the edges; 0: sharp (default)",
                    [options = options.get()](double mm) { options->generate.rounding_m = mm / 1e3; });
  add_choice_option(*command, "--facing", kFacings, "Where the apex of a cone or tetrahedron points (default right)",
                    [options = options.get()](int i) { options->generate.facing = static_cast<Facing>(i); });
  add_choice_option(*command, "--placement", kPlacements,
                    "Facets of the arc touch it at their midpoints, as the paper counts them (default), or stand on it "
                    "with their ends",
                    [options = options.get()](int i) { options->placement = static_cast<ArcPlacement>(i); });
  add_flag(*command, "--exact", options->exact,
           "The arc as a circle by its formula, which this program reads from the file's comment");
  add_unit_option(*command, options->metres_per_unit, "Unit of the file's coordinates (default mm)");
  on_run(*command, [options, &result] { result.exit_code = run_make(*options); });
}

}  // namespace tangent
