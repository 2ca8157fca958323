#include "app/scenes/Picture.h"

#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
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

Picture pictureOfBgra(std::span<const std::uint8_t> bgra, int width, int height) {
  Picture picture{width, height, std::vector<std::uint8_t>(bgra.size() / 4 * 3)};
  for (std::size_t pixel = 0; pixel < bgra.size() / 4; ++pixel)
    for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * pixel + c] = bgra[4 * pixel + 2 - c];
  return picture;
}

void requireDrawable(int width, int height) {
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    throw Error("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels: expected 1 to 16384 each way");
}

void writePng(const Picture& picture, const std::filesystem::path& path) {
  if (picture.empty()) throw Error(path.string() + ": the picture is empty; expected at least 1 x 1 pixel");
  vtkNew<vtkImageData> image;
  fillFromTop(*image, picture);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn(); // VTK itself would not say why a file cannot be written
  writer->Write();
  vtkUnsignedCharArray* const png = writer->GetResult();
  writeFile(path,
            {reinterpret_cast<const char*>(png->GetPointer(0)), static_cast<std::size_t>(png->GetNumberOfValues())},
            true);
}

} // namespace palp
