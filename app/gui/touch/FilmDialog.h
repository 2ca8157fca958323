#pragma once

#include <optional>

class QSize;
class QWidget;

namespace palp {

/// What a film of the load path is to be.
struct FilmSettings {
  bool gif = true; ///< else numbered PNG pictures in a folder
  int pictures = 40;
  int width_px = 800;
  double seconds = 4;
};

/// Asks for kind, number of pictures, width and length; none where it is cancelled. What was chosen is proposed the
/// next time. `view` is the size of what is filmed, which the pictures have the shape of.
std::optional<FilmSettings> askForFilm(QWidget* parent, const QSize& view);

/// Height of a film's pictures of this width [px]; even, as video codecs need it.
int filmHeight_px(int width_px, const QSize& view);

} // namespace palp
