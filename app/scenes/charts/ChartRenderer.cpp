#include "app/scenes/charts/ChartRenderer.h"

#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace palp {

vtkSmartPointer<vtkRenderer> chartRenderer(vtkChartXY& chart, Theme theme) {
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(&chart);
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  const Color& ground = palette(theme).ground;
  renderer->SetBackground(ground[0], ground[1], ground[2]);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  return renderer;
}

} // namespace palp
