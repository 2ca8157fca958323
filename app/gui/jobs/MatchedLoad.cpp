#include "app/gui/jobs/MatchedLoad.h"

#include "model/base/Error.h"

#include <QObject>
#include <QStringList>

namespace palp {

LoadCase matchedLoad(const LoadCase& load, const SensorDesign& from, const SensorDesign& to) {
  LoadCase matched = load;
  const Eigen::Vector2d shares = to.block_mm.head<2>().cwiseQuotient(from.block_mm.head<2>());
  if (to.block_mm != from.block_mm) {
    for (PatchLoad& disc : matched.patches) disc.centre_mm = disc.centre_mm.cwiseProduct(shares);
    for (Indenter& indenter : matched.indenters) indenter.place_mm = indenter.place_mm.cwiseProduct(shares);
  }
  if (to.areas != from.areas && !load.areas.empty())
    throw Error("the load is on area " + std::to_string(load.areas[0].area) +
                ", which is at another position on a top face of " + std::to_string(to.areas.columns) + " x " +
                std::to_string(to.areas.rows) + " areas: use a disc to compare them");
  if (const auto wrong = whyInvalid(matched, to)) throw Error(*wrong);
  return matched;
}

QString pressedWords(const LoadCase& load) {
  QStringList places;
  for (const AreaLoad& its : load.areas) places << QObject::tr("area %1").arg(its.area);
  for (const PatchLoad& disc : load.patches)
    places
        << QObject::tr("a disc at (%1, %2) mm").arg(disc.centre_mm.x(), 0, 'g', 4).arg(disc.centre_mm.y(), 0, 'g', 4);
  for (const Indenter& indenter : load.indenters)
    places << QObject::tr("a %1 at (%2, %3) mm")
                  .arg(QString::fromStdString(shapeName(indenter.shape)))
                  .arg(indenter.place_mm.x(), 0, 'g', 4)
                  .arg(indenter.place_mm.y(), 0, 'g', 4);
  return places.join(", ");
}

QString matchWords(const LoadCase& load, const SensorDesign& from, const SensorDesign& to) {
  if (from.block_mm == to.block_mm || (load.patches.empty() && load.indenters.empty())) return {};
  return QObject::tr("load: this block on %1, the other one on %2")
      .arg(pressedWords(load), pressedWords(matchedLoad(load, from, to)));
}

} // namespace palp
