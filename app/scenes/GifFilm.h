#pragma once

#include "app/scenes/Picture.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace palp {

/// Pictures one after the other as an animated GIF that begins again at its end. All have one palette of 256 colours,
/// so that parts at rest do not flicker.
class GifFilm {
public:
  /// The palette fits these pictures of the film best (median cut, Heckbert, SIGGRAPH 1982); all its pictures have the
  /// size of the first.
  explicit GifFilm(const std::vector<Picture>& typical);
  ~GifFilm();
  GifFilm(const GifFilm&) = delete;
  GifFilm& operator=(const GifFilm&) = delete;

  /// Adds a picture, shown for this time [0.01 s]. Throws Error.
  void add(const Picture& picture, int hundredths);
  /// Returns the complete file. Throws Error.
  [[nodiscard]] std::string finish();

private:
  struct Encoder;
  void choosePalette(const std::vector<Picture>& typical);
  [[nodiscard]] std::uint8_t indexOf(const std::uint8_t* rgb);
  void check(bool good) const;

  int width_ = 0, height_ = 0;
  std::vector<std::array<std::uint8_t, 3>> palette_;
  std::vector<int> indices_; ///< of the palette, by the 5 upper bits of red, green and blue; -1: not looked up yet
  std::vector<std::uint8_t> before_; ///< the last picture, as indices
  std::string content_;
  std::unique_ptr<Encoder> encoder_;
};

} // namespace palp
