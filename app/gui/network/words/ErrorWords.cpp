#include "app/gui/network/words/ErrorWords.h"

#include <QObject>
#include <QStringList>

#include <algorithm>
#include <cmath>
#include <vector>

namespace palp {

namespace {

constexpr std::size_t kOwnColumns = 4; ///< of the network's errors
constexpr double kClearly = 1.01;      ///< what the words' digits tell apart

/// A right-aligned cell of the table of errors.
QString cell(const QString& text) {
  return "<td align=\"right\" style=\"padding-left: 14px\">" + text + "</td>";
}

/// A column of numbers below its head: of Fx, Fy, Fz, and of x and y where places were learned.
struct Column {
  QString head;
  Eigen::VectorXd forces;
  Eigen::VectorXd places; ///< empty: no positions
  QString placeUnit;      ///< where it is another one than the head's
};

QString inWords(double value) {
  return std::isfinite(value) ? QString::number(value, 'g', 3) : QString("-");
}

QString table(const std::vector<Column>& columns, const QString& title, bool places) {
  QString rows = "<tr><td>" + title + "</td>";
  for (const Column& column : columns) rows += cell(column.head);
  rows += "</tr>";
  for (int d = 0; d < 3; ++d) {
    rows += QString("<tr><td>F%1</td>").arg(QLatin1Char("xyz"[d]));
    for (const Column& column : columns)
      rows += cell(d < column.forces.size() ? inWords(column.forces[d]) : QString("..."));
    rows += "</tr>";
  }
  for (int d = 0; places && d < 2; ++d) {
    rows += QObject::tr("<tr><td>position %1</td>").arg(QLatin1Char("xy"[d]));
    for (const Column& column : columns)
      rows += cell(d < column.places.size() ? inWords(column.places[d]) + column.placeUnit : QString("-"));
    rows += "</tr>";
  }
  return "<table cellspacing=\"0\" cellpadding=\"0\">" + rows + "</table>";
}

Eigen::VectorXd rootMeanSquare(const Eigen::MatrixXd& off) {
  return off.array().square().rowwise().mean().sqrt();
}

Eigen::VectorXd extent(const Eigen::MatrixXd& values) {
  return values.rowwise().maxCoeff() - values.rowwise().minCoeff();
}

/// Positions that were learned, on the loaded samples.
bool ofPlaces(const NetworkSession& session, const NetworkFit& fit) {
  return fit.error.place && session.fitIsCurrent() && fit.prediction.places_mm.cols() == session.samples()->test.size();
}

} // namespace

Eigen::VectorXd ofForces(Eigen::VectorXd errors, const Decoder& decoder) {
  for (Eigen::Index k = 0; k < std::min(errors.size(), decoder.low_N.size()); ++k)
    if (decoder.low_N(k) == 0 && decoder.high_N(k) == 0) errors(k) = NAN;
  return errors;
}

Eigen::VectorXd ofForces(Eigen::VectorXd errors, const NetworkSamples* samples) {
  for (Eigen::Index k = 0; samples != nullptr && k < std::min<Eigen::Index>(errors.size(), 3); ++k)
    if (samples->training.forces_N.row(k).isZero(0)) errors(k) = NAN;
  return errors;
}

QString errorTable(const NetworkSession& session, const NetworkFit& fit, const NoiseBound* bound,
                   const QString& title) {
  const PredictionError& error = fit.error.error;
  const bool places = ofPlaces(session, fit);
  std::vector<Column> all{
      {QObject::tr("Eq. (13) [%]"), error.eq13Percent, {}, {}},
      {QObject::tr("floored at %1 N [%]").arg(error.floor, 0, 'g', 2), error.eq13FlooredPercent, {}, {}},
      {places ? QObject::tr("mean [N, mm]") : QObject::tr("mean [N]"), error.meanAbsolute, {}, {}},
      {QObject::tr("RMSE [% of range]"), error.rmsePercentOfRange, {}, {}}};
  Eigen::Array2d range_mm = Eigen::Array2d::Ones();
  if (places) {
    const SampleSet& test = session.samples()->test;
    const Eigen::MatrixXd off_mm = fit.prediction.places_mm - test.touchedPlaces_mm();
    all[2].places = off_mm.cwiseAbs().rowwise().mean();
    all[2].placeUnit = QObject::tr(" mm");
    range_mm = extent(session.samples()->training.touchedPlaces_mm());
    all[3].places = 100 * rootMeanSquare(off_mm).array() / range_mm;
  }
  if (fit.settings.testNoise > 0 && session.fitIsCurrent() && !session.samples()->training.hasPlaces())
    all.push_back({QObject::tr("Cramer-Rao bound, with prior [% of range]"),
                   bound != nullptr ? bound->withPriorPercent : Eigen::VectorXd(),
                   {},
                   {}});
  if (session.before() != nullptr && session.before()->made != fit.made) {
    Eigen::VectorXd placesBefore;
    if (places && session.before()->error.place)
      placesBefore = 100 * session.before()->error.place->rms_mm.array() / range_mm;
    all.push_back({QObject::tr("RMSE before [% of range]"),
                   ofForces(session.before()->error.error.rmsePercentOfRange, session.before()->decoder),
                   placesBefore,
                   {}});
  }
  for (std::size_t k = 0; k < kOwnColumns; ++k) all[k].forces = ofForces(std::move(all[k].forces), fit.decoder);
  return table(all, title, places);
}

std::array<RootMeanSquares, 2> againstAGuess(const NetworkSamples& samples, const NetworkFit& fit) {
  std::array<RootMeanSquares, 2> both;
  const auto add = [&](Eigen::VectorXd RootMeanSquares::*part, const Eigen::MatrixXd& trained,
                       const Eigen::MatrixXd& tested, const Eigen::MatrixXd& predicted) {
    if (predicted.rows() != tested.rows() || predicted.cols() != tested.cols()) return;
    both[0].*part = rootMeanSquare(predicted - tested);
    both[1].*part = rootMeanSquare(tested.colwise() - trained.rowwise().mean());
  };
  add(&RootMeanSquares::forces_N, samples.training.forces_N, samples.test.forces_N, fit.prediction.forces_N);
  if (fit.error.place && samples.test.hasPlaces())
    add(&RootMeanSquares::places_mm, samples.training.touchedPlaces_mm(), samples.test.touchedPlaces_mm(),
        fit.prediction.places_mm);
  return both;
}

QString guessWords(const NetworkSession& session, const NetworkFit& fit) {
  if (!session.fitIsCurrent()) return {};
  const auto [its, guess] = againstAGuess(*session.samples(), fit);
  QStringList worse;
  const auto compare = [&worse](const QString& what, double ours, double guessed, const QString& unit) {
    if (guessed > 0 && ours > kClearly * guessed)
      worse << QObject::tr("%1 %3 %4 instead of %2 %4").arg(what, inWords(guessed), inWords(ours), unit);
  };
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(3, its.forces_N.size()); ++k)
    compare(QString("F%1").arg(QLatin1Char("xyz"[k])), its.forces_N(k), guess.forces_N(k), "N");
  for (Eigen::Index k = 0; k < its.places_mm.size(); ++k)
    compare(QObject::tr("position %1").arg(QLatin1Char("xy"[k])), its.places_mm(k), guess.places_mm(k), "mm");
  if (worse.isEmpty()) return {};
  const bool noise = fit.settings.noise < fit.settings.testNoise, all = fit.settings.rows == "all";
  return "<div>" +
         QObject::tr("Warning: worse than always predicting the training mean (RMSE): %1.").arg(worse.join(", ")) +
         (noise ? QObject::tr(" The test noise is too high for it: train with the noise of the test.")
          : all ? QObject::tr(" More samples or another decoder may help.")
                : QObject::tr(" More samples, all row-wires or another decoder may help.")) +
         "</div>";
}

QString placeWords(const NetworkFit& fit) {
  if (!fit.error.place) return {};
  return QObject::tr(" Its positions are off by %1 mm in the median, %2 and %3 mm (RMS) along x and y.")
      .arg(fit.error.place->median_mm, 0, 'g', 3)
      .arg(fit.error.place->rms_mm.x(), 0, 'g', 3)
      .arg(fit.error.place->rms_mm.y(), 0, 'g', 3);
}

QString boundWords(const NetworkSession& session, const NetworkFit& fit, const SampleBounds* touches) {
  if (touches == nullptr || !fit.error.place || !session.fitIsCurrent()) return {};
  const SampleSet& test = session.samples()->test;
  const auto words = [&](const QString& who, const std::vector<TouchDeviations>& bounds) -> QString {
    if (bounds.empty()) return {};
    const ErrorsOverBounds over = errorsOverBounds(bounds, fit.prediction.forces_N - test.forces_N,
                                                   fit.prediction.places_mm - test.touchedPlaces_mm());
    return QObject::tr(
               " Bounds (Cramer-Rao, %1, medians): Fz %2 N, position %3 mm; its errors are %4 and %5 times the bounds.")
        .arg(who)
        .arg(over.force_N, 0, 'g', 3)
        .arg(over.place_mm, 0, 'g', 3)
        .arg(over.forceRatio, 0, 'g', 3)
        .arg(over.placeRatio, 0, 'g', 3);
  };
  return words(QObject::tr("indenter known"), touches->known) +
         words(QObject::tr("unknown indenter size"), touches->sizeUnknown) +
         words(QObject::tr("at each touch, by its own model"), touches->learned);
}

QString scatterWords(const NetworkSession& session, const NetworkFit& fit) {
  if (!session.fitIsCurrent() || fit.prediction.forces_N.cols() == 0) return {};
  // Of n normal errors it scatters by 1 / sqrt(2 n) of itself.
  const auto count = static_cast<double>(fit.prediction.forces_N.cols());
  return QObject::tr(" RMSE known to about %2 % (%1 test samples).")
      .arg(count)
      .arg(100 / std::sqrt(2 * count), 0, 'g', 2);
}

QString adviceWords(const NetworkSession& session, const NetworkFit& fit) {
  if (!session.fitIsCurrent() || fit.settings.testNoise > 0 || session.samples()->training.hasPlaces()) return {};
  const QString paper = QObject::tr(" The paper does not say how it scaled its inputs, so its spreads differ from "
                                    "these: compare the smallest errors, not their positions on the axis.");
  return (fit.settings.mode == DecoderMode::Paper ? paper : QString()) +
         QObject::tr(" Set \"Test noise\" to see the Cramer-Rao noise bound with the errors.");
}

QString warningWords(const NetworkFit& fit) {
  QString words;
  for (const std::string& warning : fit.decoder.report.warnings)
    words += "<div>" + QObject::tr("Warning: %1.").arg(QString::fromStdString(warning).toHtmlEscaped()) + "</div>";
  return words;
}

} // namespace palp
