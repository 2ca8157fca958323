#include "app/gui/jobs/TouchResistances.h"

#include <QObject>

namespace palp {

std::optional<TouchResistances> resistancesOf(const SensorDesign& design, const ElectrodeDisplacements& electrodes) {
  if (design.field() != nullptr) return {};
  return TouchResistances{rowColumnResistances(design, ElectrodeDisplacements::atRest(design)),
                          rowColumnResistances(design, electrodes)};
}

QString whyNoResistances(const SensorDesign& design) {
  if (design.field() == nullptr) return {};
  return QObject::tr("Not under the conduction field here: the Resistance scene shows it.");
}

} // namespace palp
