#include "app/scenes/charts/Canvas.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace palp {

namespace {

constexpr int kDotsPerInch = 72; ///< so that a size in points is one in pixels

std::uint32_t packed(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  return 0xff000000u | red << 16 | green << 8 | blue;
}

std::uint32_t packed(const Color& color) {
  const auto part = [&](std::size_t k) { return static_cast<std::uint32_t>(std::lround(255 * color[k])); };
  return packed(part(0), part(1), part(2));
}

/// The second over the first, by its share of 255.
std::uint32_t mixed(std::uint32_t below, const std::uint8_t* rgba) {
  const std::uint32_t share = rgba[3];
  const auto part = [&](int shift, std::uint32_t above) {
    return ((below >> shift & 255u) * (255u - share) + above * share + 127u) / 255u;
  };
  return packed(part(16, rgba[0]), part(8, rgba[1]), part(0, rgba[2]));
}

int pixel(double place, int most) {
  return static_cast<int>(std::clamp(std::round(place), 0.0, static_cast<double>(most)));
}

} // namespace

Canvas::Canvas(std::uint8_t* bgra, std::size_t stride, int width, int height, WrittenWords& written)
    : pixels_(bgra), stride_(stride), width_(width), height_(height), written_(written),
      text_(vtkSmartPointer<vtkTextProperty>::New()) {}

Canvas::~Canvas() = default;

std::uint32_t* Canvas::row(int fromBelow) const {
  return reinterpret_cast<std::uint32_t*>(pixels_ + static_cast<std::size_t>(height_ - 1 - fromBelow) * stride_);
}

vtkTextProperty& Canvas::textStyle() const {
  return *text_;
}

void Canvas::clear(const Color& color) {
  fill(0, 0, width_, height_, color);
}

void Canvas::fill(double left, double bottom, double right, double top, const Color& color) {
  const int first = pixel(left, width_), last = pixel(right, width_);
  if (first >= last) return;
  const std::uint32_t ink = packed(color);
  for (int y = pixel(bottom, height_); y < pixel(top, height_); ++y) std::fill(row(y) + first, row(y) + last, ink);
}

void Canvas::frame(double left, double bottom, double right, double top, double thickness, const Color& color) {
  fill(left, bottom, right, bottom + thickness, color);
  fill(left, top - thickness, right, top, color);
  fill(left, bottom, left + thickness, top, color);
  fill(right - thickness, bottom, right, top, color);
}

const WrittenWords::Word& Canvas::written(const std::string& text) {
  constexpr std::size_t kMost = 500;
  std::ostringstream key;
  const double* color = text_->GetColor();
  key << text << '\n'
      << text_->GetFontSize() << ' ' << (text_->GetFontFile() != nullptr ? text_->GetFontFile() : "")
      << text_->GetBold() << ' ' << text_->GetOrientation() << ' ' << text_->GetJustification()
      << text_->GetVerticalJustification() << ' ' << color[0] << ' ' << color[1] << ' ' << color[2];
  if (const auto found = written_.all.find(key.str()); found != written_.all.end()) return found->second;
  if (written_.all.size() >= kMost) written_.all.clear(); // a running scale has ever new numbers
  WrittenWords::Word word{vtkSmartPointer<vtkImageData>::New()};
  std::array<int, 2> size{};
  const vtkNew<vtkTextProperty> style; // VTK keeps it, and looks at it later: ours changes from word to word
  style->ShallowCopy(text_);
  if (!vtkTextRenderer::GetInstance()->RenderString(style, text, word.letters, size.data(), kDotsPerInch))
    word.letters = nullptr;
  word.width_px = size[0];
  return written_.all.emplace(key.str(), word).first->second;
}

void Canvas::words(double x, double y, const std::string& text) {
  vtkImageData* drawn = written(text).letters; // its extent counts from the place that the text is justified about
  if (drawn == nullptr) return;
  std::array<int, 6> extent{};
  drawn->GetExtent(extent.data());
  const int left = static_cast<int>(std::lround(x)), bottom = static_cast<int>(std::lround(y));
  const int first = std::max(extent[0], -left), last = std::min(extent[1], width_ - 1 - left);
  for (int v = std::max(extent[2], -bottom); v <= std::min(extent[3], height_ - 1 - bottom); ++v) {
    const auto* letters = static_cast<const std::uint8_t*>(drawn->GetScalarPointer(extent[0], v, 0));
    std::uint32_t* pixels = row(bottom + v);
    for (int u = first; u <= last; ++u)
      if (const std::uint8_t* rgba = letters + 4 * (u - extent[0]); rgba[3] != 0)
        pixels[left + u] = mixed(pixels[left + u], rgba);
  }
}

double Canvas::wordsWidth_px(const std::string& text) {
  return written(text).width_px;
}

} // namespace palp
