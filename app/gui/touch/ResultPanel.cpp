#include "app/gui/touch/ResultPanel.h"

#include "app/gui/jobs/MatchedLoad.h"
#include "app/gui/jobs/ReferenceTouch.h"
#include "app/gui/jobs/TouchSession.h"
#include "app/gui/project/Project.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kTextWidth_px = 250; ///< of the panels, less their frames

/// As high as its words; a layout alone takes the height of the words before.
void fitHeight(QLabel& label) {
  label.setMinimumHeight(0);
  label.setMinimumHeight(label.heightForWidth(kTextWidth_px));
}

QString number(double value, int digits = 4) {
  return QString::number(value, 'g', digits);
}

/// Three numbers, each no finer than a millionth of the largest: what is less is rounding.
QString componentsText(const Eigen::Vector3d& values) {
  const double least = 1e-6 * values.cwiseAbs().maxCoeff();
  QStringList texts;
  for (const double value : values) texts << number(std::abs(value) < least ? 0 : value);
  return "(" + texts.join(", ") + ")";
}

QString contactWords(const Indenter& indenter, int index, const IndenterState& now) {
  QString words = QObject::tr("Indenter %1: %2 N, moved by %3 mm")
                      .arg(index)
                      .arg(componentsText(now.force_N), componentsText(now.translation_mm));
  if (!(now.contactArea_mm2 > 0)) return words + ".";
  words += QObject::tr("; contact radius %1 mm, area %2 mm<sup>2</sup>, %3 MPa at its centre")
               .arg(number(now.contactRadius_mm, 3), number(now.contactArea_mm2, 3), number(now.centrePressure_MPa, 3));
  if (indenter.friction > 0) words += QObject::tr("; %1 % of the contact slips").arg(number(100 * now.slipShare, 3));
  if (now.touchingNodes < kFewTouchingNodes)
    words +=
        QObject::tr(". <b>Only %1 nodes of the mesh are in contact: depth and contact are wrong; use a finer mesh</b>")
            .arg(now.touchingNodes);
  return words + ".";
}

} // namespace

ResultPanel::ResultPanel(QWidget* parent) : QWidget(parent) {
  auto* lines = new QVBoxLayout(this);
  lines->setContentsMargins(0, 0, 0, 0);
  result_ = markupLabel(tr("Not computed yet."));
  result_->setObjectName("result");
  estimate_ = pushButton(tr("Estimate the discretisation error"), "estimate",
                         tr("Solves again on a coarser mesh and compares the displacements of the electrodes"));
  uniform_ = pushButton(
      tr("Compare with uniform load"), "compareUniform",
      tr("Colours the block by the difference between this touch and the same force spread uniformly over the load "
         "area beneath it, as in the paper; the Resistance scene shows the same comparison"));
  uniform_->setCheckable(true);
  uniform_->hide();
  probe_ = markupLabel();
  probe_->setObjectName("probe");
  difference_ = markupLabel();
  difference_->setObjectName("difference");
  difference_->hide();
  for (QLabel* label : {difference_, result_, probe_}) {
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  addTo(*lines, {difference_, result_, estimate_, uniform_, probe_});
  connect(uniform_, &QPushButton::clicked, this, &ResultPanel::uniformRequested);
  connect(estimate_, &QPushButton::clicked, this, &ResultPanel::estimateRequested);
}

void ResultPanel::display(const TouchSession& session) {
  const Solution* solution = session.touch().solution();
  estimate_->setEnabled(solution != nullptr && solution->converged && session.upToDate());
  if (solution == nullptr) {
    result_->setText(tr("Not computed yet."));
    return;
  }
  const Touch& touch = session.touch();
  QStringList lines;
  if (session.fields() != nullptr) {
    Eigen::Index node = 0;
    const double largest = session.fields()->displacement_mm.colwise().norm().maxCoeff(&node);
    if (largest > 0)
      lines << tr("Largest displacement %1 mm at %2 mm.")
                   .arg(number(largest), componentsText(touch.mesh()->nodes_mm.col(node)));
    else
      lines << tr("Nothing moves.");
  }
  Eigen::Vector3d load_N = std::min(solution->reachedLoadFraction, 1.) * touch.load().totalForce_N();
  for (const IndenterState& its : solution->state().indenters) load_N += its.force_N;
  lines << tr("Load %1 N, reaction at the bottom %2 N.")
               .arg(componentsText(load_N), componentsText(solution->reaction_N));
  const bool between = session.place() != session.lastPlace();
  if (between) lines.last() += tr(" (at the end; shown: %1)").arg(loadPlaceWords(session.loadFraction()));
  for (std::size_t k = 0; k < session.indenters().size(); ++k)
    lines << contactWords(touch.load().indenters[k], static_cast<int>(k), session.indenters()[k]);
  const QString how = asWritten(QString::fromStdString(solution->stopReason));
  if (solution->converged)
    lines << tr("Converged in %1 iterations%2.").arg(solution->iterations()).arg(how.isEmpty() ? "" : "; " + how);
  else
    lines.prepend(tr("Stopped at %1: %2").arg(loadPlaceWords(solution->reachedLoadFraction), how));
  lines << tr("%1 elements (%2), %3 unknowns.")
               .arg(touch.mesh()->elementCount())
               .arg(QString::fromStdString(touch.problem()->elementType()))
               .arg(touch.problem()->dof());
  lines << tr("Largest volume error |J - 1|: %1.").arg(number(solution->maxVolumeError, 3));
  lines << tr("Discretisation error: %1")
               .arg(errorWords_.isEmpty() ? tr("not estimated yet.") : asWritten(errorWords_) + ".");
  if (!session.upToDate()) lines << tr("<i>Outdated: this result belongs to the previous design, load or mesh.</i>");
  result_->setText(lines.join("<br>"));
  fitHeight(*result_);
}

void ResultPanel::displayDifference(const Project& project, const TouchSession& session, const ReferencePath* kept,
                                    const QString& problem) {
  const bool uniform = project.view.uniform, pressed = !project.load.indenters.empty();
  const bool shown =
      project.view.lessReference && (uniform ? pressed : project.kept.has_value()) && session.fields() != nullptr;
  uniform_->setVisible(pressed);
  uniform_->setChecked(uniform && project.view.lessReference);
  difference_->setVisible(shown);
  if (!shown) return;
  const QString title = uniform ? tr("Difference from uniform load") : tr("Difference from the reference design");
  if (kept == nullptr) {
    difference_->setText(problem.isEmpty() ? tr("<b>%1:</b> computing...").arg(title)
                                           : tr("<b>%1:</b> %2.").arg(title, asWritten(problem)));
  } else {
    const Quantity quantity = project.view.quantity;
    const NodalFields less = kept->at(session.loadFraction()).fields;
    const std::vector<double> values = quantityValues(quantity, *session.fields(), less);
    const auto most =
        std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const Eigen::Index node = most - values.begin();
    const double now = quantityValues(quantity, *session.fields())[static_cast<std::size_t>(node)];
    const QString unit = QString::fromStdString(quantityUnit(quantity));
    QString match = uniform ? tr("uniform: %1").arg(pressedWords(kept->load))
                            : matchWords(session.touch().load(), session.touch().design(), kept->design);
    if (!match.isEmpty()) match[0] = match[0].toUpper();
    difference_->setText(tr("<b>%1:</b> %2 differs most at %3 mm: by %4 %7 (%5 instead of %6).")
                             .arg(title, QString::fromStdString(quantityName(quantity)),
                                  componentsText(session.touch().mesh()->nodes_mm.col(node)), number(*most),
                                  number(now), number(now - *most), unit) +
                         (match.isEmpty() ? QString() : "<br>" + match + "."));
  }
  fitHeight(*difference_);
}

void ResultPanel::displayProbe(const TouchSession& session, int node, const ReferencePath* kept) {
  if (node < 0) {
    probe_->setText(tr("Click on the block to probe a point."));
    return;
  }
  const Eigen::Vector3d place = session.touch().mesh()->nodes_mm.col(node);
  const NodalFields& fields = *session.fields();
  const Eigen::Vector3d u = fields.displacement_mm.col(node);
  const QString words =
      tr("<b>Point (%1, %2, %3) mm</b><br>u = (%4, %5, %6) mm<br>pressure %7 MPa, von Mises %8 MPa, "
         "J - 1 = %9<br>stress xx, yy, zz = %10 MPa<br>xy, yz, xz = %11 MPa<br>principal stretches %12")
          .arg(number(place.x()), number(place.y()), number(place.z()), number(u.x()), number(u.y()), number(u.z()),
               number(fields.pressure_MPa[node]), number(fields.vonMises_MPa[node]),
               number(fields.volumeRatio[node] - 1, 3), componentsText(fields.cauchy_MPa.col(node).head<3>()),
               componentsText(fields.cauchy_MPa.col(node).tail<3>()),
               componentsText(fields.principalStretches.col(node)));
  QString beside;
  if (kept != nullptr) {
    const NodalFields less = kept->at(session.loadFraction()).fields;
    beside = tr("<br><b>Compared with</b><br>u = %1 mm<br>pressure %2 MPa, von Mises %3 MPa<br>stress xx, yy, zz = %4 "
                "MPa")
                 .arg(componentsText(less.displacement_mm.col(node)), number(less.pressure_MPa[node]),
                      number(less.vonMises_MPa[node]), componentsText(less.cauchy_MPa.col(node).head<3>()));
  }
  probe_->setText(words + beside);
  fitHeight(*probe_);
}

} // namespace palp
