#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace palp {

/// An RGB image, 8 bits a channel, rows from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb; ///< 3 x width x height

  [[nodiscard]] bool empty() const { return rgb.empty(); }
};

/// Of 4 bytes a pixel: blue, green, red and one that is left out.
Picture pictureOfBgra(std::span<const std::uint8_t> bgra, int width, int height);

/// Throws Error unless a picture of this size can be drawn: 1 to 16384 pixels each way.
void requireDrawable(int width, int height);

/// Writes the picture as PNG to a temporary file and renames it. Throws Error where the file cannot be written.
void writePng(const Picture& picture, const std::filesystem::path& path);

} // namespace palp
