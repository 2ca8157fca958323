#include "app/scenes/Picture.h"

#include "model/Error.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace palp {

namespace {

/// VTK's images have their first row at the bottom.
void fillFromTop(vtkImageData& image, const Picture& picture) {
  image.SetDimensions(picture.width, picture.height, 1);
  image.AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.rgb.data() + row * static_cast<std::size_t>(y), row,
                static_cast<std::uint8_t*>(image.GetScalarPointer(0, picture.height - 1 - y, 0)));
}

} // namespace

void requireWritable(const std::filesystem::path& path) {
  if (!std::ofstream(path, std::ios::app))
    throw Error(path.string() + ": cannot be written; allowed is a file in a folder that exists and may be written to");
}

void writePng(const Picture& picture, const std::filesystem::path& path) {
  if (picture.empty()) throw Error(path.string() + ": the picture is empty; allowed is at least 1 x 1 pixel");
  const std::filesystem::path part = path.string() + ".part";
  requireWritable(part);
  vtkNew<vtkImageData> image;
  fillFromTop(*image, picture);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(part.c_str());
  writer->Write();
  std::error_code failure;
  if (writer->GetErrorCode() == 0) std::filesystem::rename(part, path, failure);
  if (writer->GetErrorCode() != 0 || failure) {
    std::filesystem::remove(part, failure);
    throw Error(path.string() + ": cannot be written; allowed is a file in a folder that exists and may be written to");
  }
}

} // namespace palp
