#include "app/gui/touch/LoadPathAnimation.h"

#include "app/gui/jobs/CallLater.h"
#include "app/gui/jobs/LoadPath.h"
#include "app/gui/jobs/TouchSession.h"
#include "app/gui/views/BlockView.h"
#include "app/scenes/gl/OffscreenWindow.h"
#include "model/base/Error.h"

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>

namespace palp {

namespace {

std::string frameName(int frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "load-%03d.png", frame);
  return name.data();
}

} // namespace

/// What the pictures are drawn with.
struct LoadPathAnimation::Easel {
  Easel() = default;
  Easel(const Easel&) = delete;
  Easel& operator=(const Easel&) = delete;
  /// What the renderer holds belongs to the window's context: it goes first.
  ~Easel() { window.vtk()->RemoveRenderer(scene.renderer()); }

  DeformationScene scene;
  OffscreenWindow window;
  bool begun = false;
};

/// The computed touch and its states; shared with the job.
struct LoadPathAnimation::Path {
  Touch touch;
  std::vector<LoadPathState> states;
};

/// A picture asked of the window by the job, which waits for it.
struct LoadPathAnimation::Order {
  std::shared_ptr<const Path> path;
  Settings settings;
  LoadPathState state;
  std::mutex mutex;
  std::condition_variable_any drawn;
  std::optional<Picture> picture;
  std::string problem; ///< why there is none
};

LoadPathAnimation::LoadPathAnimation(const TouchSession& session, const BlockView& view, QObject* parent)
    : QObject(parent), session_(session), view_(view) {
  connect(&runner_, &JobRunner::finished, this, [this] { easel_.reset(); });
}

LoadPathAnimation::~LoadPathAnimation() = default;

bool LoadPathAnimation::start(const Settings& settings) {
  if (session_.lastPlace() < 1) return false;
  easel_.reset();
  const auto work = [this, settings, touch = session_.touch()](const std::stop_token& stop,
                                                               JobProgress& progress) -> JobRunner::Taking {
    auto path = std::make_shared<Path>(Path{touch, {}});
    progress.set(-1, "Fields along the load path");
    path->states = loadPathStates(touch, stop);
    if (stop.stop_requested()) return {};
    // One colour scale over the whole path.
    Settings fixed = settings;
    std::vector<double> all;
    for (const LoadPathState& state : path->states) {
      const Quantity quantity = settings.options.quantity;
      const std::vector<double> values =
          settings.kept ? quantityValues(quantity, state.fields, settings.kept->at(state.fraction).fields)
                        : quantityValues(quantity, state.fields);
      all.insert(all.end(), values.begin(), values.end());
    }
    if (!fixed.options.fixedRange) fixed.options.fixedRange = quantityRange(settings.options, all);
    if (!fixed.options.warpFactor)
      fixed.options.warpFactor = automaticWarpFactor(touch.design(), path->states.back().fields.displacement_mm);
    const double last = path->states.back().fraction;
    for (int frame = 0; frame < settings.frames; ++frame) {
      progress.set(static_cast<double>(frame) / settings.frames,
                   "Picture " + std::to_string(frame + 1) + " of " + std::to_string(settings.frames));
      auto order = std::make_shared<Order>();
      order->path = path;
      order->settings = fixed;
      order->state = stateAt(path->states, last * frame / std::max(settings.frames - 1, 1));
      if (!drawInWindow(order, stop)) return {};
      if (!order->problem.empty()) throw Error(order->problem);
      writePng(*order->picture, settings.folder / frameName(frame));
    }
    return [this, settings] {
      emit done(tr("Wrote %1 pictures, %2.")
                    .arg(settings.frames)
                    .arg(QString::fromStdString((settings.folder / "load-*.png").string())) +
                tr(" A program such as ffmpeg makes one film of them: ffmpeg -i load-%03d.png film.mp4"));
    };
  };
  runner_.start(tr("Drawing the load path"), work);
  return true;
}

bool LoadPathAnimation::drawInWindow(const std::shared_ptr<Order>& order, const std::stop_token& stop) {
  callLater(*this, [this, order] { fill(*order); });
  std::unique_lock lock(order->mutex);
  return order->drawn.wait(lock, stop, [&] { return order->picture || !order->problem.empty(); });
}

/// In the window's thread; a drawing that fails is the job's to report, for it waits.
void LoadPathAnimation::fill(Order& order) {
  std::optional<Picture> picture;
  std::string problem;
  try {
    picture = draw(*order.path, order.settings, order.state.fields, order.state.electrodes, order.state.fraction);
  } catch (const std::exception& failure) {
    problem = std::string("the load path cannot be drawn: ") + failure.what();
  } catch (...) {
    problem = "the load path cannot be drawn";
  }
  const std::lock_guard lock(order.mutex);
  order.picture = std::move(picture);
  order.problem = std::move(problem);
  order.drawn.notify_one();
}

Picture LoadPathAnimation::draw(const Path& path, const Settings& settings, const NodalFields& fields,
                                const ElectrodeDisplacements& electrodes, double fraction) {
  requireDrawable(settings.width, settings.height);
  if (!easel_) easel_ = std::make_unique<Easel>();
  DeformationScene& scene = easel_->scene;
  const SensorDesign& design = path.touch.design();
  DeformationState state{&design, path.touch.mesh(), &fields, &electrodes, &path.touch.load(), fraction};
  std::optional<LoadPathState> less;
  if (settings.kept) {
    state.keptDesign = &settings.kept->design;
    state.kept = &less.emplace(settings.kept->at(fraction)).fields;
  }
  scene.show(state, settings.options, !easel_->begun);
  if (!easel_->begun) {
    easel_->window.setSize(settings.width, settings.height);
    easel_->window.vtk()->AddRenderer(scene.renderer());
    scene.renderer()->GetActiveCamera()->DeepCopy(view_.camera());
    easel_->begun = true;
  }
  scene.renderer()->ResetCameraClippingRange();
  easel_->window.render();
  return easel_->window.picture();
}

} // namespace palp
