#pragma once

#include "app/scenes/Picture.h"

#include <cstdint>
#include <memory>
#include <string>

class vtkRenderWindow;
class vtkRenderer;

namespace palp {

/// A VTK render window without a display: an EGL device, else EGL without a surface, else an offscreen X window.
/// For one thread. Throws Error where none of the three comes up.
class OffscreenWindow {
public:
  OffscreenWindow();
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  [[nodiscard]] vtkRenderWindow* vtk() const;
  /// "EGL device", "EGL surfaceless" or "offscreen X", with the renderer's name.
  [[nodiscard]] const std::string& route() const;

  void setSize(int width, int height);
  void render();
  /// What was rendered last.
  [[nodiscard]] Picture picture() const;
  /// The same as 4 bytes a pixel (blue, green, red, 255), rows from the top, `stride` bytes apart.
  void copyBgra(std::uint8_t* pixels, std::size_t stride) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Draws the renderer once, in a window of its own.
Picture drawOnce(vtkRenderer* renderer, int width, int height);

} // namespace palp
