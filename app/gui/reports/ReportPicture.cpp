#include "app/gui/reports/ReportPicture.h"

#include <QFontDatabase>
#include <QLabel>

#include <algorithm>

namespace palp {

namespace {

constexpr int kWidth_px = 900; ///< at most

} // namespace

ReportPicture::ReportPicture(const QString& words, QWidget* parent)
    : QScrollArea(parent), words_(words), label_(new QLabel(words)) {
  label_->setObjectName("reportPicture");
  label_->setAlignment(Qt::AlignCenter);
  setWidget(label_);
  setWidgetResizable(true);
}

void ReportPicture::show(const QPixmap& picture) {
  if (picture.isNull()) return;
  clear(); // the label's is of the same width
  picture_ = picture;
  // Always there: a bar that comes and goes would change the width that the picture has.
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
  fit();
}

void ReportPicture::say(const QString& text) {
  clear();
  label_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  label_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  label_->setTextFormat(Qt::PlainText);
  label_->setText(text);
}

void ReportPicture::clear() {
  picture_ = {};
  label_->setFont(font());
  label_->setAlignment(Qt::AlignCenter);
  label_->setText(words_);
}

void ReportPicture::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  fit();
}

void ReportPicture::fit() {
  if (picture_.isNull()) return;
  const double ratio = devicePixelRatioF();
  const int width = qRound(std::min(kWidth_px, viewport()->width()) * ratio);
  if (label_->pixmap().width() == width) return;
  QPixmap scaled = picture_.scaledToWidth(std::max(width, 1), Qt::SmoothTransformation);
  scaled.setDevicePixelRatio(ratio);
  label_->setPixmap(scaled);
}

} // namespace palp
