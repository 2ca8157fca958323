#include "app/cli/Pictures.h"
#include "model/base/Error.h"

#include <iostream>

namespace palp {

namespace {

std::string needsVtk(const std::string& what) {
  return what + " needs VTK, and this palp was built without it (PALP_GUI=OFF)";
}

/// Pictures of a report may be missing: the rest of it is written.
void warn(Session& session, const std::string& what) {
  session.warnings.push_back(needsVtk(what));
  std::cerr << "palp: " << session.warnings.back() << '\n';
}

} // namespace

void exportVtu(const OutputFile& output, const Mesh&, const NodalFields*, const CurrentField*, Session&) {
  throw Error(needsVtk(output.path.string()));
}

std::vector<ReportPicture> drawPaperFigures(const SensorDesign&, const ProtocolResult&, const MeshOptions&,
                                            FilesTogether&, Session& session) {
  warn(session, "drawing the figures");
  return {};
}

ReportDrawer reportDrawer(Session&) {
  return {}; // the page and the report's warnings say so
}

void renderTouch(const Touch&, const std::string&, const PictureSize&, const std::filesystem::path& file, Session&) {
  throw Error(needsVtk(file.string()));
}

std::vector<std::string> quantityNames() {
  return {};
}

} // namespace palp
