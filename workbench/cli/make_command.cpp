// workbench make: writes the paper's objects and the hard cases as OBJ files.
#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generate_hard.h"
#include "workbench/cli/command.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/number_option.h"
#include "workbench/cli/text_format.h"

#include <array>
#include <cstdio>
#include <memory>

namespace tangent {
namespace {

constexpr std::array<std::string_view, 2> kFacings{"left", "right"};  // order of Facing

struct MakeOptions {
  std::string object;
  GenerateOptions generate;
  std::filesystem::path file;
  double metres_per_unit = kMillimetre;
};

int run_make(const MakeOptions& options) {
  const Result<PolygonMesh> mesh = generate_mesh(options.object, options.generate);
  if (!mesh) {
    print_message("make", mesh.error().message());
    return kUsage;  // the object or its options do not exist
  }
  if (const Status status = write_obj(*mesh, options.file, options.metres_per_unit); !status) {
    print_message("make", status.error().message());
    return kFailed;
  }
  std::fputs(format("%s: %s, %zu vertices, %zu faces\n", options.file.c_str(), options.object.c_str(),
                    mesh->positions.size(), mesh->face_count())
                 .c_str(),
             stdout);
  return kDone;
}

}  // namespace

void add_make_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = app.add_subcommand("make", "Write one of the paper's objects or a hard case as OBJ");
  auto options = std::make_shared<MakeOptions>();
  std::string names;
  for (const std::string& name : generator_names()) names += (names.empty() ? "" : " ") + name;
  names += "; hard cases:";
  for (const std::string& name : hard_mesh_names()) names += " " + name;
  command->add_option("OBJECT", options->object, names)->required()->type_name("");
  command->add_option("--out", options->file, "File to write")->required()->type_name("F.obj");
  add_number_option(*command, "--segments", {.min = 1, .max = 100000, .whole = true},
                    "Around a round object, subdivisions of an icosphere, lines of a grid (default: the object's own)",
                    [options = options.get()](double n) { options->generate.segments = static_cast<int>(n); });
  add_number_option(*command, "--rounding-mm", {.min = 0.0, .max = 1000.0, .unit = "mm"},
                    "Radius of the edges; 0: sharp (default)",
                    [options = options.get()](double mm) { options->generate.rounding_m = mm / 1e3; });
  add_choice_option(*command, "--facing", kFacings, "Where the apex of a cone or tetrahedron points (default right)",
                    [options = options.get()](int i) { options->generate.facing = static_cast<Facing>(i); });
  add_unit_option(*command, options->metres_per_unit, "Unit of the file's coordinates (default mm)");
  command->callback([options, &result] { result.exit_code = run_make(*options); });
}

}  // namespace tangent
