#include "app/gui/design/DesignPresets.h"

#include <QObject>

namespace palp {

std::vector<DesignPreset> designPresets() {
  const SensorDesign paper = paperDesign();
  SensorDesign following = paper;
  following.lowerFollowsRubber = true;
  SensorDesign incompressible = paper;
  incompressible.material.poissonRatio = 0.5;
  SensorDesign fine = paper;
  fine.areas.columns = 4;
  fine.areas.rows = 3;
  SensorDesign piezoresistive = paper;
  piezoresistive.pressureLaw = PressureLaw{};
  return {
      {QObject::tr("Paper's sensor"),
       QObject::tr("Sensor of F. Wang et al. 2013 (see Help, About): 30 x 30 x 5 mm, 10 x 30 wires, six load areas"),
       paper},
      {QObject::tr("Lower electrodes follow the rubber"),
       QObject::tr("The paper fixes the lower electrodes. Where they follow the rubber, dR changes by more than half."),
       following},
      {QObject::tr("Incompressible rubber"), QObject::tr("The paper's sensor with a Poisson's ratio of 0.5"),
       incompressible},
      {QObject::tr("Twelve load areas"), QObject::tr("The paper's block with 4 x 3 load areas"), fine},
      {QObject::tr("Resistivity falls with pressure"),
       QObject::tr("The paper's sensor with the pressure law of its Fig. 1"), piezoresistive}};
}

} // namespace palp
