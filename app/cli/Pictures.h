#pragma once

#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/paper/PaperReport.h"
#include "app/study/reports/Report.h"
#include "app/study/touch/Touch.h"
#include "io/FilesTogether.h"
#include "model/Mesh.h"
#include "model/Solution.h"
#include "solver/ConductionField.h"

#include <filesystem>
#include <vector>

namespace palp {

// What needs VTK. Without it (PALP_GUI=OFF) each adds a warning, and the command continues.

/// VTU file of the mesh, with the fields at its nodes and current paths where there are any; sets `file` in the
/// result.
void exportVtu(const OutputFile& output, const Mesh& mesh, const NodalFields* fields, const CurrentField* current,
               Session& session);

/// Figs. 4, 6-16 as PNG files of the report. Throws Cancelled where the session is stopped.
std::vector<ReportPicture> drawPaperFigures(const SensorDesign& design, const ProtocolResult& result,
                                            const MeshOptions& mesh, FilesTogether& files, Session& session);

/// Draws a report's charts and maps; nothing without VTK.
ReportDrawer reportDrawer(Session& session);

struct PictureSize {
  int width = 1200;
  int height = 800;
  bool dark = false;
};

/// The deformed block, coloured by one of quantityNames(), as a PNG file; sets `file` in the result.
void renderTouch(const Touch& touch, const std::string& quantity, const PictureSize& size,
                 const std::filesystem::path& file, Session& session);

/// What a picture can be coloured by; empty without VTK.
std::vector<std::string> quantityNames();

} // namespace palp
