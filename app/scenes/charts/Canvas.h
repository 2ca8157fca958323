#pragma once

#include "app/scenes/Palette.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <map>
#include <string>

class vtkImageData;
class vtkTextProperty;

namespace palp {

/// Words as written before, for a view that writes the same in each frame: VTK's own store of letters belongs to all
/// views and forgets them.
struct WrittenWords {
  struct Word {
    vtkSmartPointer<vtkImageData> letters; ///< null where there is nothing to see
    int width_px = 0;
  };
  std::map<std::string, Word> all; ///< by text and style
};

/// A flat picture painted by the processor: rectangles, and text of VTK's. For a view of some hundred rectangles this
/// costs less than clearing and reading back the window of a software renderer. Places count in pixels from the lower
/// left, as VTK's do.
class Canvas {
public:
  /// Paints on pixels of 4 bytes (blue, green, red, 255), rows from the top, `stride` bytes apart.
  Canvas(std::uint8_t* bgra, std::size_t stride, int width, int height, WrittenWords& written);
  virtual ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  void clear(const Color& color);
  /// A rectangle, its edges rounded to pixels.
  virtual void fill(double left, double bottom, double right, double top, const Color& color);
  /// The frame of a rectangle, `thickness` pixels to its inside.
  void frame(double left, double bottom, double right, double top, double thickness, const Color& color);
  /// Typeface, colour, turning and justification of the words to come.
  [[nodiscard]] vtkTextProperty& textStyle() const;
  virtual void words(double x, double y, const std::string& text);
  [[nodiscard]] double wordsWidth_px(const std::string& text);

private:
  [[nodiscard]] std::uint32_t* row(int fromBelow) const;
  const WrittenWords::Word& written(const std::string& text);

  std::uint8_t* pixels_;
  std::size_t stride_;
  int width_, height_;
  WrittenWords& written_;
  vtkSmartPointer<vtkTextProperty> text_;
};

} // namespace palp
