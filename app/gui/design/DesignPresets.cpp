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
  return {{QObject::tr("the paper's"),
           QObject::tr("of F. Wang et al. 2013 (Help, About): 30 x 30 x 5 mm, 10 x 30 wires, six load areas"), paper},
          {QObject::tr("lower electrodes follow the rubber"),
           QObject::tr("the paper holds them still; where they follow, dR changes by more than half"), following},
          {QObject::tr("incompressible rubber"), QObject::tr("the paper's with Poisson's ratio 0.5"), incompressible},
          {QObject::tr("twelve load areas"), QObject::tr("the paper's block with 4 x 3 areas"), fine},
          {QObject::tr("resistivity falls with pressure"), QObject::tr("the paper's with the law of Fig. 1"),
           piezoresistive}};
}

} // namespace palp
