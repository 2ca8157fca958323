#include "app/cli/Cli.h"
#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/Pictures.h"
#include "app/study/touch/Touch.h"

#include <algorithm>
#include <iostream>
#include <memory>

namespace palp {

namespace {

struct RenderArguments {
  std::string design;
  std::string quantity = "|u|";
  std::string width = "1200", height = "800";
  bool dark = false;
  MeshChoice mesh;
  LoadOptions loads;
  OutputFile output;
};

void requireKnown(const std::string& quantity) {
  const std::vector<std::string> names = quantityNames();
  if (names.empty() || std::find(names.begin(), names.end(), quantity) != names.end()) return;
  std::string choices;
  for (const std::string& name : names) choices += (choices.empty() ? "" : ", ") + name;
  throw badValue("--quantity", quantity, "one of " + choices);
}

Exit run(const RenderArguments& arguments, Session& session) {
  const SensorDesign design = designOption(arguments.design);
  const LoadCase load = arguments.loads.loadCase(design);
  const PictureSize size{wholeNumber("--width", arguments.width, 200, 8000),
                         wholeNumber("--height", arguments.height, 200, 8000), arguments.dark};
  requireKnown(arguments.quantity);
  arguments.output.requireWritable();
  if (arguments.output.path.extension() != ".png")
    throw badValue("--output", arguments.output.path.string(), "a name that ends in .png");
  printMeshCost(design, meshFor(design, load, arguments.mesh.options()), session);
  Touch touch(design, load, arguments.mesh.options());
  NewtonOptions options;
  options.threads = session.threads;
  const bool converged = touch.advance(Stage::Displacements, options, {{}, session.stop});
  session.stages.add(touch.stages());
  session.result["converged"] = converged;
  session.result["reached_load_fraction"] = touch.solution()->reachedLoadFraction;
  if (!converged) {
    session.result["stop_reason"] = touch.solution()->stopReason;
    std::cerr << "palp render: " << touch.solution()->stopReason << "; the picture shows the last converged state\n";
  }
  if (session.stop.stop_requested()) return Exit::NoResult;
  renderTouch(touch, arguments.quantity, size, arguments.output.path, session);
  if (!session.json && session.result.contains("file")) std::cout << arguments.output.path.string() << " written\n";
  return converged ? Exit::Done : Exit::NoResult;
}

} // namespace

void addRender(Cli& cli) {
  auto arguments = std::make_shared<RenderArguments>();
  Command command = cli.command("render", "Draws a picture of the deformed block, without a display.",
                                "palp render paper --load 0:1,0,-6 -o picture.png",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.option("design", arguments->design, "DESIGN", "design file, or paper").required();
  arguments->loads.declare(command);
  arguments->loads.declareIndenters(command);
  arguments->mesh.declare(command, false);
  command.group("Picture");
  command.option("--quantity", arguments->quantity, "TEXT",
                 "quantity of the colours: |u| (default), ux, uy, uz, pressure, ...");
  command.option("--width", arguments->width, "N", "width in pixels (default 1200)");
  command.option("--height", arguments->height, "N", "height in pixels (default 800)");
  command.flag("--dark", arguments->dark, "dark background");
  arguments->output.declare(command, "PNG file to write").required();
}

} // namespace palp
