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
  return QObject::tr("Not available with the conduction field here: see the Resistance scene.");
}

} // namespace palp
