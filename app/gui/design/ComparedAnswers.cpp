#include "app/gui/design/ComparedAnswers.h"

#include "app/gui/design/BoundWords.h"
#include "app/gui/design/RestFloor.h"
#include "app/gui/jobs/MatchedLoad.h"
#include "app/study/touch/Touch.h"
#include "model/base/Error.h"
#include "solver/MeshCost.h"

#include <QObject>

#include <array>

namespace palp {

namespace {

/// A design under a load.
struct Answer {
  double largest_mm = 0;                    ///< displacement
  Eigen::MatrixXd change;                   ///< dR / R at rest [%]
  std::optional<Eigen::Matrix3Xd> upper_mm; ///< displacements of the upper electrodes
  QString problem;                          ///< why there is no answer
};

Answer answerOf(const SensorDesign& design, const LoadCase& load, const SensorDesign& loaded, const MeshOptions& mesh,
                const std::stop_token& stop) {
  Answer answer;
  try {
    Touch touch(design, matchedLoad(load, loaded, design), mesh);
    const bool good = touch.advance(Stage::Resistances, {}, {.step = {}, .stop = stop});
    if (stop.stop_requested()) return answer;
    if (!good) {
      answer.problem = QString::fromStdString(touch.solution()->stopReason);
      return answer;
    }
    answer.largest_mm = touch.solution()->state().displacements_mm.colwise().norm().maxCoeff();
    const Eigen::MatrixXd rest_ohm = resistancesAtRest_ohm(design);
    answer.change = 100 * (*touch.resistances_ohm() - rest_ohm).cwiseQuotient(rest_ohm);
    answer.upper_mm = touch.displacements()->upper_mm;
  } catch (const Error& error) {
    answer.problem = error.what();
  }
  return answer;
}

/// Empty where there is no such mesh; the answer contains the reason.
std::string costOf(const SensorDesign& design, const DesignsCompared& compared, const MeshOptions& mesh) {
  try {
    return costInBrief(meshCost(design, meshFor(design, matchedLoad(compared.load, compared.now, design), mesh)));
  } catch (const Error&) {
    return {};
  }
}

QString answerWords(const Answer& earlier, const Answer& now, const DesignsCompared& compared) {
  for (const auto& [answer, name] :
       {std::pair{&earlier, QObject::tr("The earlier design")}, std::pair{&now, QObject::tr("This design")}})
    if (!answer->problem.isEmpty()) return QObject::tr("%1 cannot carry the load: %2.").arg(name, answer->problem);
  QString words = QObject::tr("Under the load on %1: largest displacement %2 mm before, <b>%3 mm</b> now.")
                      .arg(pressedWords(compared.load), QString::number(earlier.largest_mm, 'f', 4),
                           QString::number(now.largest_mm, 'f', 4));
  if (const QString match = matchWords(compared.load, compared.now, compared.earlier); !match.isEmpty())
    words += QObject::tr(
                 "<br>The blocks differ in size, %1: at the same share of the sides, with the same radius and force.")
                 .arg(match);
  if (earlier.upper_mm->cols() == now.upper_mm->cols())
    words += QObject::tr("<br>The displacements of the upper electrodes differ by up to %1 mm.")
                 .arg((*now.upper_mm - *earlier.upper_mm).colwise().norm().maxCoeff(), 0, 'f', 4);
  if (earlier.change.rows() != now.change.rows() || earlier.change.cols() != now.change.cols())
    words += QObject::tr(
        "<br>The designs have different numbers of wires, so their resistances are not compared cell by cell.");
  return words;
}

} // namespace

bool compareDesigns(DesignsCompared& compared, const MeshOptions& mesh, const ReportProgress& progress,
                    const std::stop_token& stop) {
  progress(0.01, QObject::tr("this design under the load").toStdString() + costOf(compared.now, compared, mesh));
  const Answer now = answerOf(compared.now, compared.load, compared.now, mesh, stop);
  if (stop.stop_requested()) return false;
  progress(0.05,
           QObject::tr("the earlier design under the load").toStdString() + costOf(compared.earlier, compared, mesh));
  const Answer earlier = answerOf(compared.earlier, compared.load, compared.now, mesh, stop);
  const bool atRest =
      compared.earlier.field() != nullptr || compared.now.field() != nullptr; // where the field is known
  std::shared_ptr<const RestFloor> floor;
  for (const bool present : {false, true}) {
    const SensorDesign& design = present ? compared.now : compared.earlier;
    const double from = present ? 0.55 : 0.1;
    const QString whose = present ? QObject::tr("this design: %1") : QObject::tr("the earlier design: %1");
    const auto part = [&](double share, const std::string& what) {
      progress(from + 0.45 * share, whose.arg(QString::fromStdString(what)).toStdString());
    };
    std::optional<DesignBounds> bounds;
    if (atRest) {
      floor = restFloor(design, mesh, floor, part, stop);
      if (floor) bounds = boundsAtRest(*floor, compared.noise);
    } else {
      bounds = designBounds(design, mesh, compared.noise, 0, part, stop);
    }
    if (!bounds || stop.stop_requested()) return false;
    (present ? compared.nowBounds : compared.earlierBounds) = summaryOf(*bounds);
  }
  compared.words = answerWords(earlier, now, compared).toStdString();
  compared.rows = compared.columns = 0;
  compared.difference_percent.clear();
  if (earlier.change.rows() != now.change.rows() || earlier.change.cols() != now.change.cols() ||
      now.change.size() == 0)
    return true;
  compared.rows = static_cast<int>(now.change.rows());
  compared.columns = static_cast<int>(now.change.cols());
  for (int row = 0; row < compared.rows; ++row)
    for (int column = 0; column < compared.columns; ++column)
      compared.difference_percent.push_back(now.change(row, column) - earlier.change(row, column));
  return true;
}

} // namespace palp
