#include "app/gui/reports/ReportPicture.h"

#include "app/gui/widgets/FileDialogs.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QFontDatabase>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>

#include <algorithm>

namespace palp {

namespace {

constexpr int kWidth_px = 900;                ///< at most
constexpr const char* kPoints = "points.csv"; ///< of every chart of a report

QString textOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

} // namespace

ReportPicture::ReportPicture(const QString& words, QWidget* parent)
    : QScrollArea(parent), words_(words), label_(new QLabel(words)) {
  label_->setObjectName("reportPicture");
  label_->setAlignment(Qt::AlignCenter);
  setFocusPolicy(Qt::StrongFocus); // the menu key
  setAccessibleName(tr("Picture of the report"));
  setWidget(label_);
  setWidgetResizable(true);
}

void ReportPicture::show(const QString& png) {
  const QPixmap picture(png);
  if (picture.isNull()) return;
  clear(); // the label's is of the same width
  picture_ = picture;
  file_ = png;
  // Always there: a bar that comes and goes would change the width that the picture has.
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
  fit();
}

void ReportPicture::say(const QString& text) {
  clear();
  label_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  label_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  label_->setTextFormat(Qt::PlainText);
  label_->setWordWrap(true);
  label_->setText(text);
}

void ReportPicture::clear() {
  picture_ = {};
  file_.clear();
  label_->setFont(font());
  label_->setWordWrap(false);
  label_->setAlignment(Qt::AlignCenter);
  label_->setText(words_);
}

void ReportPicture::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  fit();
}

void ReportPicture::contextMenuEvent(QContextMenuEvent* event) {
  if (file_.isEmpty()) return;
  const QDir folder = QFileInfo(file_).dir();
  const QString points = folder.filePath(kPoints);
  const QString own = folder.filePath(QFileInfo(file_).completeBaseName() + ".csv"); // a map has none
  QMenu menu(this);
  menu.addAction(tr("Copy picture"), this, [this] { QApplication::clipboard()->setPixmap(picture_); });
  menu.addAction(tr("Save picture, %1 x %2 pixels...").arg(picture_.width()).arg(picture_.height()), this,
                 [this] { saveAs(file_, tr("Save picture"), tr("Pictures (*.png)")); });
  if (QFileInfo::exists(own)) {
    menu.addAction(tr("Copy points of this chart"), this, [own] { QApplication::clipboard()->setText(textOf(own)); });
    menu.addAction(tr("Save points of this chart as CSV..."), this,
                   [this, own] { saveAs(own, tr("Save as CSV"), tr("Tables (*.csv)")); });
  }
  if (QFileInfo::exists(points)) {
    menu.addAction(tr("Copy points of the report"), this,
                   [points] { QApplication::clipboard()->setText(textOf(points)); });
    menu.addAction(tr("Save points of the report as CSV..."), this,
                   [this, points] { saveAs(points, tr("Save as CSV"), tr("Tables (*.csv)")); });
  }
  const bool byKey = event->reason() == QContextMenuEvent::Keyboard;
  menu.exec(byKey ? mapToGlobal(rect().center()) : event->globalPos());
}

void ReportPicture::saveAs(const QString& from, const QString& title, const QString& filter) {
  const QString to = askFileToSave(this, title, QFileInfo(from).fileName(), filter);
  if (to.isEmpty() || QFileInfo(to) == QFileInfo(from)) return; // it lies there
  try {
    writeFile(to.toStdString(), readFile(from.toStdString()), true); // confirmed in the dialog
    emit message(tr("Wrote %1.").arg(to));
  } catch (const Error& error) {
    QMessageBox::warning(this, title, QString::fromStdString(error.what()));
  }
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
