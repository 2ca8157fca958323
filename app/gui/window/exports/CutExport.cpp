#include "app/gui/window/exports/CutExport.h"

#include "app/gui/project/ResultCsv.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/touch/DeformationPage.h"
#include "app/gui/window/exports/ExportSource.h"
#include "app/scenes/CutTable.h"

#include <QObject>

namespace palp {

QString cutProblem(Workbench& workbench, const DeformationPage& page) {
  if (workbench.touch().fields() == nullptr)
    return QObject::tr("There is no solution to export yet; wait until it is computed on the Deformation scene.");
  if (!page.blockOptions().cut)
    return QObject::tr("There is no cut: choose one across x, y or z in the panel of the Deformation scene.");
  if (page.blockOptions().lessKept && !page.shownLess())
    return QObject::tr("The difference from the reference design is not available yet; wait until it is computed.");
  return {};
}

ExportJob::Making cutMaking(Workbench& workbench, const DeformationPage& page) {
  const TouchSession& touch = workbench.touch();
  return [shown = touch.touch(), fields = *touch.fields(), fraction = touch.loadFraction(), kept = page.shownLess(),
          options = page.blockOptions(), stale = touchStale(workbench)](const std::stop_token& stop) {
    DeformationState state;
    state.design = &shown.design();
    state.mesh = shown.mesh();
    state.fields = &fields;
    std::optional<LoadPathState> less;
    if (kept) state.kept = &less.emplace(kept->at(fraction)).fields;
    const ResultSource source{shown.design(), shown.load(), fraction, shown.meshOptions(), stale};
    return (sourceLines(source) + "# cut across " + "xyz"[options.cut->axis] + " at " +
            QString::number(options.cut->at_mm, 'g', 12) + " mm of the block as it is drawn, displacements times " +
            QString::number(options.warpFactor.value_or(automaticWarpFactor(shown.design(), fields.displacement_mm))) +
            "\n")
               .toStdString() +
           cutCsv(state, options, stop);
  };
}

} // namespace palp
