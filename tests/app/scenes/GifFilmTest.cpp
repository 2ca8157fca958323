#include "app/scenes/GifFilm.h"

#include "tests/io/Refusal.h"

#include <gif_lib.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace palp {
namespace {

void paint(Picture& picture, int x, int y, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  const auto at = 3 * static_cast<std::size_t>(y * picture.width + x);
  picture.rgb[at] = red;
  picture.rgb[at + 1] = green;
  picture.rgb[at + 2] = blue;
}

Picture plain(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  Picture picture{width, height, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width * height))};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) paint(picture, x, y, red, green, blue);
  return picture;
}

struct Reading {
  std::string content;
  std::size_t at = 0;
};

int readBytes(GifFileType* file, GifByteType* bytes, int count) {
  auto& reading = *static_cast<Reading*>(file->UserData);
  const std::size_t there = std::min(static_cast<std::size_t>(count), reading.content.size() - reading.at);
  std::memcpy(bytes, reading.content.data() + reading.at, there);
  reading.at += there;
  return static_cast<int>(there);
}

/// The film as somebody else's reader shows it.
struct Shown {
  std::vector<Picture> pictures;
  std::vector<int> hundredths;
};

Shown shown(const std::string& content) {
  Reading reading{content};
  int why = 0;
  GifFileType* file = DGifOpen(&reading, readBytes, &why);
  Shown film;
  if (file == nullptr || DGifSlurp(file) != GIF_OK) {
    ADD_FAILURE() << "no GIF";
    return film;
  }
  Picture canvas = plain(file->SWidth, file->SHeight, 0, 0, 0);
  for (int k = 0; k < file->ImageCount; ++k) {
    const SavedImage& image = file->SavedImages[k];
    const GifImageDesc& part = image.ImageDesc;
    for (int y = 0; y < part.Height; ++y)
      for (int x = 0; x < part.Width; ++x) {
        const GifColorType& color = file->SColorMap->Colors[image.RasterBits[y * part.Width + x]];
        paint(canvas, part.Left + x, part.Top + y, color.Red, color.Green, color.Blue);
      }
    film.pictures.push_back(canvas);
    GraphicsControlBlock control{};
    DGifSavedExtensionToGCB(file, k, &control);
    film.hundredths.push_back(control.DelayTime);
  }
  DGifCloseFile(file, &why);
  return film;
}

TEST(GifFilm, ShowsItsPicturesForTheirTimes) {
  std::vector<Picture> pictures{plain(7, 5, 255, 255, 255)};
  pictures.push_back(pictures[0]);
  paint(pictures[1], 3, 2, 200, 16, 16);
  pictures.push_back(pictures[1]); // nothing changes
  pictures.push_back(plain(7, 5, 16, 16, 200));
  GifFilm film(pictures);
  for (std::size_t k = 0; k < pictures.size(); ++k) film.add(pictures[k], 4 + static_cast<int>(k));
  const Shown seen = shown(film.finish());
  ASSERT_EQ(seen.pictures.size(), pictures.size());
  for (std::size_t k = 0; k < pictures.size(); ++k) EXPECT_EQ(seen.pictures[k].rgb, pictures[k].rgb) << k;
  EXPECT_EQ(seen.hundredths, (std::vector<int>{4, 5, 6, 7}));
}

TEST(GifFilm, KeepsAColourScaleToAFewLevels) {
  Picture ramp = plain(256, 64, 0, 0, 0);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 256; ++x)
      paint(ramp, x, y, static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(255 - x),
            static_cast<std::uint8_t>(2 * y));
  GifFilm film({ramp});
  film.add(ramp, 4);
  const Shown seen = shown(film.finish());
  ASSERT_EQ(seen.pictures.size(), 1u);
  int most = 0;
  for (std::size_t k = 0; k < ramp.rgb.size(); ++k)
    most = std::max(most, std::abs(int{ramp.rgb[k]} - int{seen.pictures[0].rgb[k]}));
  // 32 x 16 bins of 8 levels each share 256 colours: a box is at most 2 x 2 bins, 16 levels to each side of its middle.
  EXPECT_LE(most, 16);
}

TEST(GifFilm, GivesColoursOutsideOfItsPaletteTheNearestOne) {
  Picture two = plain(2, 1, 250, 250, 250);
  paint(two, 0, 0, 8, 8, 8);
  GifFilm film({two});
  film.add(plain(2, 1, 200, 190, 210), 4);
  const Shown seen = shown(film.finish());
  ASSERT_EQ(seen.pictures.size(), 1u);
  EXPECT_EQ(seen.pictures[0].rgb, plain(2, 1, 250, 250, 250).rgb);
}

TEST(GifFilm, RefusesAPictureOfAnotherSize) {
  GifFilm film({plain(4, 4, 1, 2, 3)});
  EXPECT_NE(refusal([&] { film.add(plain(4, 3, 1, 2, 3), 4); }).find("one size"), std::string::npos);
}

} // namespace
} // namespace palp
