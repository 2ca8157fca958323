#include "app/gui/design/NoiseFloor.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/DesignFields.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/study/decoding/NoiseBound.h"
#include "model/base/Cancelled.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include <cmath>
#include <numeric>

namespace palp {

namespace {

QString sampleBoundWords(int row, const NoiseBound& one, const NoiseBound& every, const ForceRange& range) {
  const auto both = [&](const NoiseBound& bound) {
    return boundPercents(bound.withPriorPercent) + "</b><br>= <b>" + boundNewtons(bound.withPriorPercent, range);
  };
  return QObject::
      tr("Cramer-Rao bound of Fx / Fy / Fz from the samples, loaded area known, with prior (the best linear estimate "
         "of forces of this range; a method that uses the limits can be up to 5 % better), in % of range and in "
         "N:<br>row-wire %1 alone: <b>%2</b><br>all row-wires: <b>%3</b><br>without prior: row-wire %1 %4, all "
         "%5<br><i>Always predicting the mean gives 28.9 %. Real rubber adds hysteresis, creep and temperature.</i>")
          .arg(row)
          .arg(both(one), both(every), boundPercents(one.withoutPriorPercent),
               boundPercents(every.withoutPriorPercent));
}

QString computing() {
  return QObject::tr("Computing...");
}

/// Side by side: the read-out in use is bold.
QString restBoundWords(const RestBounds& bounds, const SensorDesign& design) {
  QString rows;
  const auto add = [&rows](const QString& name, const DesignBounds& bound, bool bold) {
    QString cells;
    for (QString cell : {name, boundPercents(bound.centreRow.withPrior()), boundPercents(bound.allRows.withPrior())}) {
      cell.replace(' ', "&nbsp;");
      cells += "<td>" + (bold ? "<b>" + cell + "</b>" : cell) + "&nbsp;&nbsp;</td>";
    }
    rows += "<tr>" + cells + "</tr>";
  };
  const std::vector<DesignChoice>& readouts = designField("resistance.readout").choices;
  for (std::size_t k = 0; k < readouts.size(); ++k)
    add(readouts[k].words, bounds.readouts[k], design.field()->readout == static_cast<Readout>(k));
  add(QObject::tr("Eq. (1) for comparison"), bounds.pairs, false);
  return QObject::tr("Cramer-Rao bound of Fx / Fy / Fz at rest, loaded area known, with prior (the best linear "
                     "estimate; a method that uses the range's limits can be up to 5 % better), in % of "
                     "range:<table><tr><td></td><td>row-wire %1</td><td>all row-wires</td></tr>%2</table><i>Always "
                     "predicting the mean gives 28.9 %. The rubber's conductivity is isotropic, also where it is "
                     "deformed; real rubber adds hysteresis, creep and temperature.</i>")
      .arg(centreRowWire(design.rowWires()))
      .arg(rows);
}

} // namespace

NoiseFloor::NoiseFloor(Workbench& workbench, NetworkSession& network, QWidget* parent)
    : QGroupBox(tr("Noise floor of the design"), parent), workbench_(workbench), network_(network) {
  auto* column = new QVBoxLayout(this);
  noise_ = new RatioBox(100, "%");
  noise_->setObjectName("resistanceNoise");
  noise_->setRange(0.00001, 10);
  noise_->setDecimals(5);
  noise_->setPrefix(tr("Noise of R: "));
  noise_->setKeyboardTracking(false);
  noise_->setToolTip(tr("Relative noise of each reading, in percent or as a ratio with an exponent (1e-4 is 0.01 %); a "
                        "good board has 0.0005 %, a plain one 0.01 %"));
  column->addWidget(noise_);
  words_ = markupLabel();
  words_->setObjectName("noiseFloor");
  words_->setWordWrap(true);
  words_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* scrolled = new QScrollArea; // the table of all read-outs is higher than a low window
  scrolled->setObjectName("noiseFloorScroll");
  scrolled->setWidget(words_);
  scrolled->setWidgetResizable(true);
  scrolled->setFrameShape(QFrame::NoFrame);
  scrolled->setMinimumHeight(2 * words_->fontMetrics().lineSpacing());
  column->addWidget(scrolled, 1);
  samples_ = pushButton(tr("Generate samples"), "floorSamples",
                        tr("Generates samples as on the Network scene; the bound follows from how the resistances "
                           "change with the force"));
  column->addWidget(samples_);
  connect(noise_, &QDoubleSpinBox::valueChanged, this, [this](double percent) {
    workbench_.edit(tr("Change the noise of the resistances"),
                    [&](Project& next) { next.view.resistanceNoise = percent / 100; });
  });
  connect(samples_, &QPushButton::clicked, this,
          [this] { network_.generate(workbench_.project().samples, workbench_.project().mesh); });
  connect(&network_, &NetworkSession::samplesChanged, this, [this] {
    boundedFor_.reset();
    display();
  });
  // What was cancelled is requested again when the page is next updated.
  connect(&bounding_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled) return;
    forget();
    if (words_->text() == computing()) words_->setText(tr("Cancelled; any edit of the design starts it again."));
  });
  connect(&bounding_, &JobRunner::failed, this, [this](const QString& sentence) { showWords(*words_, sentence); });
}

void NoiseFloor::forget() {
  boundedFor_.reset();
  asked_.reset();
  bounds_.reset();
}

void NoiseFloor::showEvent(QShowEvent* event) {
  QGroupBox::showEvent(event);
  display();
}

/// The block's answer is some 20 MB, computed again in a second or two.
void NoiseFloor::hideEvent(QHideEvent* event) {
  QGroupBox::hideEvent(event);
  floor_.reset();
}

void NoiseFloor::display() {
  const Project& project = workbench_.project();
  showExactly(*noise_, 100 * project.view.resistanceNoise);
  if (!isVisible()) return;
  project.design.field() != nullptr ? displayField() : displayPairs();
}

void NoiseFloor::displayPairs() {
  if (std::exchange(asked_, std::nullopt)) bounding_.cancel(); // the field's is wanted no more
  const bool known = network_.upToDate();
  samples_->setVisible(!known);
  if (!known) {
    words_->setText(tr("Available once there are samples of this design."));
    return;
  }
  if (network_.samples()->training.hasTouches()) {
    words_->setText(tr(
        "The existing samples are touches of an indenter, but this noise floor is for forces on the load areas. "
        "Generate samples of forces on areas in the Network scene, or use the resolution map, which is for touches."));
    return;
  }
  const double noise = workbench_.project().view.resistanceNoise;
  if (boundedFor_ == noise) return;
  boundedFor_ = noise;
  words_->setText(computing());
  boundPairs(noise);
}

void NoiseFloor::boundPairs(double noise) {
  bounding_.start(tr("Computing the noise floor"),
                  [this, noise, samples = network_.sharedSamples()](const std::stop_token& stop,
                                                                    JobProgress&) -> JobRunner::Taking {
                    std::vector<int> all(static_cast<std::size_t>(samples->training.rowWires));
                    std::iota(all.begin(), all.end(), 0);
                    const int centre = centreRowWire(samples->training.rowWires);
                    const NoiseBound one = noiseBound(samples->training, InputKind::Resistance, {centre}, noise);
                    throwIfStopped(stop);
                    const NoiseBound every = noiseBound(samples->training, InputKind::Resistance, all, noise);
                    return [this, noise, samples, centre, one, every] {
                      if (samples == network_.sharedSamples() && boundedFor_ == noise)
                        words_->setText(sampleBoundWords(centre, one, every, workbench_.project().design.forceRange));
                    };
                  });
}

void NoiseFloor::displayField() {
  boundedFor_.reset();
  samples_->hide();
  const Project& project = workbench_.project();
  const double noise = project.view.resistanceNoise;
  if (asked_ && asked_->isOf(project.design, project.mesh) && askedNoise_ == noise) {
    if (bounds_) words_->setText(restBoundWords(*bounds_, project.design)); // of another read-out: all were computed
    return;
  }
  asked_ = RestFloor{project.design, project.mesh, {}, {}};
  askedNoise_ = noise;
  bounds_.reset();
  words_->setText(computing());
  boundField(noise);
}

void NoiseFloor::boundField(double noise) {
  bounding_.start(tr("Computing the noise floor"),
                  [this, noise, design = asked_->design, mesh = asked_->mesh,
                   before = floor_](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
                    const auto floor = restFloor(
                        design, mesh, before, [&](double share, const std::string& what) { progress.set(share, what); },
                        stop);
                    if (!floor) return {};
                    const RestBounds bounds = restBounds(*floor, noise);
                    return [this, noise, floor, bounds] {
                      if (!asked_ || !floor->isOf(asked_->design, asked_->mesh) || askedNoise_ != noise) return;
                      if (isVisible()) floor_ = floor;
                      bounds_ = bounds;
                      // The design may have changed since where the page has not been brought up to date: another
                      // scene's undo, or an edit that is still to be shown.
                      const Project& now = workbench_.project();
                      if (floor->isOf(now.design, now.mesh)) words_->setText(restBoundWords(bounds, now.design));
                    };
                  });
}

} // namespace palp
