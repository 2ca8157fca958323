#include "app/scenes/charts/ChartSvg.h"

#include "app/scenes/charts/ChartRenderer.h"
#include "app/scenes/gl/OffscreenWindow.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <vtkChartXY.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace palp {

namespace {

/// A file of its own that goes with it.
class ScratchFile {
public:
  ScratchFile() : path_((std::filesystem::temp_directory_path() / "palp-chart-XXXXXX").string()) {
    const int descriptor = ::mkstemp(path_.data());
    if (descriptor < 0)
      throw Error(path_ + ": cannot be created; expected a folder for temporary files that can be written to (TMPDIR)");
    ::close(descriptor);
  }
  ~ScratchFile() { ::unlink(path_.c_str()); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

private:
  std::string path_;
};

} // namespace

std::string chartSvg(const ChartSpec& spec, int width, int height, Theme theme, double scale) {
  vtkNew<vtkChartXY> chart;
  fillChart(*chart, spec, theme, scale, {static_cast<double>(width), static_cast<double>(height)});
  const vtkSmartPointer<vtkRenderer> renderer = chartRenderer(*chart, theme);
  OffscreenWindow window; // the chart is laid out as it is drawn
  window.vtk()->AddRenderer(renderer);
  window.setSize(width, height);
  window.render();
  const ScratchFile scratch; // VTK writes files only
  vtkNew<vtkSVGExporter> exporter;
  exporter->SetRenderWindow(window.vtk());
  exporter->SetFileName(scratch.path().c_str());
  exporter->Write();
  return readFile(scratch.path());
}

} // namespace palp
