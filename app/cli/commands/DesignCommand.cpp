#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "io/DesignFile.h"
#include "model/MaterialCheck.h"

#include <iostream>
#include <memory>

namespace palp {

namespace {

struct DesignArguments {
  std::string preset = "paper";
  std::string checked;
  OutputFile output;
};

void describe(const SensorDesign& design, Session& session) {
  const Material& rubber = design.material;
  session.result["fingerprint"] = designFingerprint(design);
  session.result["row_wires"] = design.rowWires();
  session.result["electrodes_per_row_wire"] = design.electrodesPerRowWire();
  session.result["column_wires"] = design.columnWires();
  session.result["electrodes_per_column_wire"] = design.electrodesPerColumnWire();
  session.result["areas"] = design.areas.count();
  session.result["resistance_law"] = design.field() ? "field" : "pairs";
  if (design.field()) session.result["readout"] = kReadouts.name(design.field()->readout);
  session.result["rubber_law"] = kRubberLaws.name(kindOf(rubber.law));
  session.result["shear_modulus_MPa"] = rubber.shearModulus_MPa();
  session.result["compressibility_per_MPa"] = rubber.compressibility_per_MPa();
  session.result["small_strain_young_MPa"] = rubber.smallStrainYoung_MPa();
  session.result["small_strain_poisson_ratio"] = rubber.smallStrainPoissonRatio();
  if (auto why = whyNotSquare(design))
    session.result["square_system"] = *why;
  else
    session.result["square_system"] = true;
}

Exit run(const DesignArguments& arguments, Session& session) {
  if (!arguments.checked.empty()) {
    const SensorDesign design = designOption(arguments.checked);
    session.result["file"] = arguments.checked;
    describe(design, session);
    for (const std::string& warning : designWarnings(design)) session.warnings.push_back(warning);
    if (const auto warning = stabilityWarning(design.material)) session.warnings.push_back(*warning);
    if (session.json) return Exit::Done;
    std::cout << arguments.checked << ": the design can be built\n";
    for (const std::string& warning : session.warnings) std::cout << "warning: " << warning << '\n';
    return Exit::Done;
  }
  if (arguments.preset != "paper") throw badValue("--preset", arguments.preset, "paper");
  const SensorDesign design = paperDesign();
  session.warnings.emplace_back("the paper prints E = 2.08e5 N/mm2 (steel); it contradicts c10 and c01 by five orders "
                                "of magnitude and is not used");
  describe(design, session);
  if (arguments.output.path.empty()) {
    if (session.json)
      session.result["design"] = nlohmann::ordered_json::parse(toJson(design));
    else
      std::cout << toJson(design) << '\n';
    return Exit::Done;
  }
  arguments.output.requireWritable();
  saveDesign(arguments.output.path, design, arguments.output.force);
  session.result["file"] = arguments.output.path.string();
  if (!session.json) std::cout << arguments.output.path.string() << " written\n";
  return Exit::Done;
}

} // namespace

void addDesign(Cli& cli) {
  auto arguments = std::make_shared<DesignArguments>();
  Command command = cli.command("design", "Writes a design file, or checks one.", "palp design -o sensor.json",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.group("Design");
  Option preset = command.option("--preset", arguments->preset, "TEXT", "design to write: paper (default)");
  command.option("--check", arguments->checked, "FILE", "design file to check").excludes(preset);
  arguments->output.declare(command, "design file to write (default: standard output)");
}

} // namespace palp
