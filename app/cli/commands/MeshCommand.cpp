#include "app/cli/Cli.h"
#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/Pictures.h"
#include "app/study/touch/Touch.h"
#include "io/AtomicFile.h"
#include "model/base/Cancelled.h"
#include "solver/CalculixDeck.h"
#include "solver/MeshQuality.h"

#include <iostream>
#include <memory>

namespace palp {

namespace {

struct MeshArguments {
  std::string design;
  std::string format;
  MeshChoice mesh;
  LoadOptions loads;
  OutputFile output;
};

Exit run(const MeshArguments& arguments, Session& session) {
  const SensorDesign design = designOption(arguments.design);
  const bool deck = arguments.format == "inp";
  if (deck && arguments.output.path.empty()) throw UsageError("--format inp: give the file with -o deck.inp");
  arguments.output.requireWritable();
  LoadCase load;
  if (deck) load = arguments.loads.loadCase(design);
  printMeshCost(design, meshFor(design, load, arguments.mesh.options()), session);
  Touch touch(design, load, arguments.mesh.options());
  touch.advance(Stage::Mesh, {}, {{}, session.stop});
  session.stages.add(touch.stages());
  throwIfStopped(session.stop);
  const Mesh& mesh = *touch.mesh();
  const MeshQuality quality = meshQuality(mesh);
  session.result["nodes"] = mesh.nodeCount();
  session.result["elements"] = mesh.elementCount();
  session.result["element_type"] = shapeName(mesh.shape);
  session.result["dof"] = freeUnknowns(mesh);
  session.result["min_dihedral_deg"] = quality.minDihedral_deg;
  session.result["max_dihedral_deg"] = quality.maxDihedral_deg;
  if (deck)
    writeFile(arguments.output.path, calculixDeck(design, mesh, load), arguments.output.force);
  else if (!arguments.output.path.empty())
    exportVtu(arguments.output, mesh, nullptr, nullptr, session);
  if (!session.json)
    std::cout << mesh.elementCount() << " elements (" << shapeName(mesh.shape) << "), " << mesh.nodeCount()
              << " nodes, " << freeUnknowns(mesh) << " unknowns\ndihedral angles " << quality.minDihedral_deg << " to "
              << quality.maxDihedral_deg << " deg\nmeshed in " << session.stages.counts().at("mesh").seconds << " s\n";
  return Exit::Done;
}

} // namespace

void addMesh(Cli& cli) {
  auto arguments = std::make_shared<MeshArguments>();
  Command command =
      cli.command("mesh", "Meshes the block of a design.", "palp mesh sensor.json --mesh-size 2 -o mesh.vtu",
                  [arguments](Session& session) { return run(*arguments, session); });
  command.option("design", arguments->design, "DESIGN", "design file, or paper").required();
  arguments->mesh.declare(command, false);
  arguments->loads.declare(command);
  arguments->loads.declareIndenters(command);
  command.group("Output");
  command
      .option("--format", arguments->format, "TEXT", "vtu, or inp for a CalculiX/Abaqus deck with loads and indenters")
      .oneOf({"vtu", "inp"})
      .byDefault("vtu");
  arguments->output.declare(command, "mesh file to write");
}

} // namespace palp
