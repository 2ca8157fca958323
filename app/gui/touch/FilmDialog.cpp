#include "app/gui/touch/FilmDialog.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QSize>
#include <QSpinBox>

#include <algorithm>

namespace palp {

namespace {

constexpr double kMostASecond = 50; ///< that a GIF can show: its times are hundredths of a second

} // namespace

int filmHeight_px(int width_px, const QSize& view) {
  const double share = view.width() > 0 ? static_cast<double>(view.height()) / view.width() : 2.0 / 3;
  return std::clamp(2 * qRound(0.5 * width_px * share), 2, 4096);
}

std::optional<FilmSettings> askForFilm(QWidget* parent, const QSize& view) {
  const FilmSettings usual;
  QSettings kept;
  QDialog dialog(parent);
  dialog.setObjectName("film");
  dialog.setWindowTitle(QObject::tr("Film of the load path"));
  auto* form = new QFormLayout(&dialog);
  auto* kind =
      choiceBox("filmKind", {QObject::tr("Animated GIF"), QObject::tr("Numbered PNG pictures in a folder")},
                QObject::tr("A GIF plays directly in slides and browsers, with 256 colours. Numbered PNG pictures "
                            "can be turned into a full-colour video with another program."));
  kind->setCurrentIndex(kept.value("film/gif", usual.gif).toBool() ? 0 : 1);
  auto* pictures = wholeBox("filmPictures", {.low = 2, .high = 500, .whileTyping = true},
                            QObject::tr("Number of pictures from rest to the full load, in equal steps of the load"));
  pictures->setValue(kept.value("film/pictures", usual.pictures).toInt());
  auto* width = wholeBox("filmWidth", {.low = 100, .high = 3840, .unit = QObject::tr(" px"), .whileTyping = true},
                         QObject::tr("Width of the pictures, which have the shape of the view"));
  width->setValue(kept.value("film/width", usual.width_px).toInt());
  auto* seconds =
      numberBox("filmSeconds", {.low = 0.5, .high = 120, .decimals = 1, .unit = QObject::tr(" s"), .whileTyping = true},
                QObject::tr("Duration of the film before it repeats"));
  seconds->setValue(kept.value("film/seconds", usual.seconds).toDouble());
  auto* words = textLabel("filmWords");
  form->addRow(QObject::tr("Create"), kind);
  form->addRow(QObject::tr("Pictures"), pictures);
  form->addRow(QObject::tr("Width"), width);
  form->addRow(QObject::tr("Length"), seconds);
  form->addRow(words);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Ok)->setText(QObject::tr("Choose a file..."));
  form->addRow(buttons);
  const auto say = [&] {
    const double rate = pictures->value() / seconds->value();
    const bool quick = kind->currentIndex() == 0 && rate > kMostASecond;
    const QString size = QObject::tr("%1 x %2 pixels, %3 pictures per second.")
                             .arg(width->value())
                             .arg(filmHeight_px(width->value(), view))
                             .arg(rate, 0, 'g', 3);
    words->setText(
        quick ? size + QObject::tr(" A GIF shows at most 50 per second: use fewer pictures or a longer duration.")
              : size);
    buttons->button(QDialogButtonBox::Ok)->setEnabled(!quick);
  };
  QObject::connect(kind, &QComboBox::currentIndexChanged, &dialog, say);
  for (QSpinBox* box : {pictures, width}) QObject::connect(box, &QSpinBox::valueChanged, &dialog, say);
  QObject::connect(seconds, &QDoubleSpinBox::valueChanged, &dialog, say);
  QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  say();
  if (dialog.exec() != QDialog::Accepted) return {};
  const FilmSettings chosen{kind->currentIndex() == 0, pictures->value(), width->value(), seconds->value()};
  kept.setValue("film/gif", chosen.gif);
  kept.setValue("film/pictures", chosen.pictures);
  kept.setValue("film/width", chosen.width_px);
  kept.setValue("film/seconds", chosen.seconds);
  return chosen;
}

} // namespace palp
