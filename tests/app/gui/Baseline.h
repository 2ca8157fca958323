#pragma once

#include "app/scenes/Picture.h"

#include <gtest/gtest.h>

#include <string>

namespace palp {

/// How far a picture is from another of its size.
struct PictureDifference {
  /// Largest mean difference of a channel over a tile of 16 x 16 pixels, 0 to 255: a thing that has gone or changed its
  /// colour shows in its tile, however small it is beside the picture.
  double worstTile = 0;
  double mean = 0; ///< of all channels and pixels, 0 to 255
};
PictureDifference pictureDifference(const Picture& a, const Picture& b);
/// Not farther apart than edges and letters of two versions of a renderer are.
bool looksTheSame(const PictureDifference& difference);

/// The picture is that of tests/app/gui/baselines/NAME.png, but for what another version of the software renderer or of
/// FreeType may do to edges and letters. Where it is not, the picture and a picture of the difference lie in the folder
/// of temporary files, and the message says so. With PALP_UPDATE_BASELINES=1 the baseline is written anew.
testing::AssertionResult matchesBaseline(const Picture& picture, const std::string& name);

} // namespace palp
