#include "tests/app/gui/Baseline.h"

#include <QDir>
#include <QImage>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palp {

namespace {

constexpr int kTile_px = 16;

/// Between what may change and what may not (BaselineTest prints the figures): half a pixel to the right, more than a
/// renderer's version does to edges and letters, changes the worst tile by 20 to 24 and the mean by 1.9 to 3.3. A
/// missing arrow changes the worst tile by 89, another warp factor by 43, missing electrodes by 38 and the mean by 12,
/// another colour map by 132. Thin faint lines (the mesh's edges, 2.4) are below what can be told from another
/// renderer.
constexpr double kWorstTile = 30;
constexpr double kWorstMean = 5;

QImage imageOf(const Picture& picture) {
  return QImage(picture.rgb.data(), picture.width, picture.height, 3 * picture.width, QImage::Format_RGB888).copy();
}

Picture baselinePicture(const QImage& image) {
  const QImage rgb = image.convertToFormat(QImage::Format_RGB888);
  Picture picture{rgb.width(), rgb.height(), {}};
  for (int y = 0; y < rgb.height(); ++y)
    picture.rgb.insert(picture.rgb.end(), rgb.constScanLine(y), rgb.constScanLine(y) + 3 * rgb.width());
  return picture;
}

/// Differences three times as strong as they are, on black.
Picture differencePicture(const Picture& a, const Picture& b) {
  Picture difference = a;
  for (std::size_t k = 0; k < a.rgb.size(); ++k)
    difference.rgb[k] = static_cast<std::uint8_t>(std::min(255, 3 * std::abs(a.rgb[k] - b.rgb[k])));
  return difference;
}

} // namespace

PictureDifference pictureDifference(const Picture& a, const Picture& b) {
  PictureDifference difference;
  double sum = 0;
  for (int top = 0; top < a.height; top += kTile_px)
    for (int left = 0; left < a.width; left += kTile_px) {
      double tile = 0;
      int values = 0;
      for (int y = top; y < std::min(top + kTile_px, a.height); ++y)
        for (int k = 3 * left; k < 3 * std::min(left + kTile_px, a.width); ++k, ++values) {
          const auto at = static_cast<std::size_t>(3 * a.width * y + k);
          tile += std::abs(a.rgb[at] - b.rgb[at]);
        }
      sum += tile;
      difference.worstTile = std::max(difference.worstTile, tile / values);
    }
  difference.mean = sum / static_cast<double>(a.rgb.size());
  return difference;
}

bool looksTheSame(const PictureDifference& difference) {
  return difference.worstTile <= kWorstTile && difference.mean <= kWorstMean;
}

testing::AssertionResult matchesBaseline(const Picture& picture, const std::string& name) {
  const QString file = QString(PALP_BASELINES_DIR "/%1.png").arg(QString::fromStdString(name));
  if (qEnvironmentVariableIntValue("PALP_UPDATE_BASELINES") == 1)
    return imageOf(picture).save(file) ? testing::AssertionSuccess()
                                       : testing::AssertionFailure() << file.toStdString() << " cannot be written";
  const QImage image(file);
  if (image.isNull()) return testing::AssertionFailure() << file.toStdString() << " is not there";
  const Picture wanted = baselinePicture(image);
  const QString kept = QDir::temp().filePath(QString("palp-%1").arg(QString::fromStdString(name)));
  if (wanted.width != picture.width || wanted.height != picture.height)
    return testing::AssertionFailure() << name << ": " << picture.width << " x " << picture.height
                                       << " px, the baseline " << wanted.width << " x " << wanted.height;
  const PictureDifference difference = pictureDifference(picture, wanted);
  if (looksTheSame(difference)) return testing::AssertionSuccess();
  imageOf(picture).save(kept + ".png");
  imageOf(differencePicture(picture, wanted)).save(kept + "-difference.png");
  return testing::AssertionFailure() << name << ": worst tile " << difference.worstTile << " (at most " << kWorstTile
                                     << "), mean " << difference.mean << " (at most " << kWorstMean << "); see "
                                     << kept.toStdString() << ".png and " << kept.toStdString()
                                     << "-difference.png beside " << file.toStdString();
}

} // namespace palp
