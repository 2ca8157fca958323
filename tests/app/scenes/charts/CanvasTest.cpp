#include "app/scenes/charts/Canvas.h"

#include "app/scenes/charts/TextStyle.h"

#include <vtkTextProperty.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace palp {
namespace {

constexpr int kSize_px = 80;

/// A view that writes a label from below upwards, and then a title; where its picture has ink.
std::vector<bool> labelAndTitle(const std::string& label, const Color& ink) {
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(kSize_px) * kSize_px);
  WrittenWords written;
  Canvas canvas(reinterpret_cast<std::uint8_t*>(pixels.data()), 4UL * kSize_px, kSize_px, kSize_px, written);
  canvas.clear({1, 1, 1});
  const std::uint32_t paper = pixels[0];
  setTextStyle(canvas.textStyle(), ink, 12);
  canvas.textStyle().SetOrientation(90);
  canvas.words(20, 5, label);
  setTextStyle(canvas.textStyle(), ink, 15, true);
  canvas.textStyle().SetOrientation(0);
  canvas.words(30, 60, "Title");
  std::vector<bool> inked(pixels.size());
  std::transform(pixels.begin(), pixels.end(), inked.begin(), [&](std::uint32_t pixel) { return pixel != paper; });
  return inked;
}

/// VTK keeps a few typefaces at a time, and loads one that it gave up as the style that was handed to it is by then.
TEST(Canvas, WritesNewLettersAsBeforeAfterManyOtherStyles) {
  const Color ink{0.1, 0.2, 0.3}, another{0.3, 0.2, 0.1};
  labelAndTitle("muft", ink);
  const auto expected = labelAndTitle("row-wire", another);
  for (int other = 0; other < 100; ++other) labelAndTitle("muft", {0.005 * other, 0.5, 0.5});
  EXPECT_TRUE(labelAndTitle("row-wire", ink) == expected);
}

} // namespace
} // namespace palp
