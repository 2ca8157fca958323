#include "app/cli/Pictures.h"

#include "app/scenes/VtuFile.h"
#include "app/scenes/block/DeformationPicture.h"
#include "app/scenes/charts/PaperFigures.h"
#include "app/scenes/charts/ReportCharts.h"
#include "model/base/Cancelled.h"

namespace palp {

void exportVtu(const OutputFile& output, const Mesh& mesh, const NodalFields* fields, const CurrentField* current,
               Session& session) {
  output.requireWritable();
  std::vector<NodalArray> arrays = fields ? nodalArrays(*fields) : std::vector<NodalArray>{};
  if (current) {
    arrays.push_back({"potential_V", current->potential_V.transpose()});
    arrays.push_back({"current_density_A_per_mm2", current->currentDensity_A_per_mm2});
    arrays.push_back({"power_density_W_per_mm3", current->powerDensity_W_per_mm3.transpose()});
  }
  writeVtu(output.path, mesh, arrays);
  session.result["file"] = output.path.string();
}

std::vector<ReportPicture> drawPaperFigures(const SensorDesign& design, const ProtocolResult& result,
                                            const MeshOptions& mesh, FilesTogether& files, Session& session) {
  Touch touch(design, paperFigureLoad(), mesh);
  NewtonOptions options;
  options.threads = session.threads;
  touch.advance(Stage::Displacements, options, {{}, session.stop});
  throwIfStopped(session.stop); // half a load makes no figure
  session.stages.add(touch.stages());
  return session.stages.measure("render", [&] { return drawPaperFigures(result, touch, files, session.stop); });
}

ReportDrawer reportDrawer(Session& session) {
  const auto drawn = [&session](const auto& drawing, const std::filesystem::path& png) {
    session.stages.measure("render", [&] { drawReport(drawing, png); });
  };
  return {drawn, drawn};
}

void renderTouch(const Touch& touch, const std::string& quantity, const PictureSize& size,
                 const std::filesystem::path& file, Session& session) {
  DeformationOptions options;
  for (const Quantity candidate : allQuantities())
    if (quantityName(candidate) == quantity) options.quantity = candidate;
  options.theme = size.dark ? Theme::Dark : Theme::Light;
  const NodalFields fields = touch.problem()->fields(touch.solution()->state());
  DeformationState state;
  state.design = &touch.design();
  state.mesh = touch.mesh();
  state.fields = &fields;
  state.electrodes = touch.displacements();
  state.load = &touch.load();
  state.loadFraction = touch.solution()->reachedLoadFraction;
  state.indenters = touch.solution()->state().indenters;
  session.stages.measure("render", [&] { writePng(drawDeformation(state, options, size.width, size.height), file); });
  session.result["file"] = file.string();
}

std::vector<std::string> quantityNames() {
  std::vector<std::string> names;
  for (const Quantity quantity : allQuantities()) names.push_back(quantityName(quantity));
  return names;
}

} // namespace palp
