#include "app/cli/Pictures.h"

#include <iostream>

namespace palp {

namespace {

void warn(Session& session, const std::string& what) {
  session.warnings.push_back(what + " needs VTK, and this palp was built without it (PALP_GUI=OFF)");
  std::cerr << "palp: " << session.warnings.back() << '\n';
}

} // namespace

void exportVtu(const OutputFile& output, const Mesh&, const NodalFields*, Session& session) {
  warn(session, output.path.string());
}

std::vector<ReportPicture> drawPaperFigures(const SensorDesign&, const ProtocolResult&, const MeshOptions&,
                                            WrittenFiles&, Session& session) {
  warn(session, "drawing the figures");
  return {};
}

ChartDrawer chartDrawer(Session& session) {
  warn(session, "drawing the charts");
  return {};
}

void renderTouch(const Touch&, const std::string&, const PictureSize&, const std::filesystem::path& file,
                 Session& session) {
  warn(session, file.string());
}

std::vector<std::string> quantityNames() {
  return {};
}

} // namespace palp
