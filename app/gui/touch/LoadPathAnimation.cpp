#include "app/gui/touch/LoadPathAnimation.h"

#include "app/gui/jobs/CallLater.h"
#include "app/gui/jobs/LoadPath.h"
#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/jobs/TouchSession.h"
#include "app/gui/views/BlockView.h"
#include "app/scenes/GifFilm.h"
#include "app/scenes/gl/OffscreenWindow.h"
#include "io/FilesTogether.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <QElapsedTimer>

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <map>

namespace palp {

namespace {

std::string frameName(int frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "load-%03d.png", frame);
  return name.data();
}

/// Reports which picture is drawn, and how long the rest will take.
class FrameProgress {
public:
  FrameProgress(JobProgress& progress, int frames) : progress_(progress), frames_(frames) {
    clock_.start();
    left_.begin(0, 0);
  }
  void next() {
    const double now_s = 1e-3 * static_cast<double>(clock_.elapsed());
    progress_.set(static_cast<double>(done_) / frames_, "Picture " + std::to_string(done_ + 1) + " of " +
                                                            std::to_string(frames_) +
                                                            leftInWords(left_.left_s(done_, frames_, now_s)));
    ++done_;
  }

private:
  JobProgress& progress_;
  QElapsedTimer clock_;
  TimeLeft left_;
  int frames_;
  int done_ = 0;
};

/// A picture of the film by its number; none where it was stopped.
using Drawn = std::function<std::optional<Picture>(int)>;

/// False where it was stopped.
bool drawPictures(const LoadPathAnimation::Settings& settings, const Drawn& drawn, FrameProgress& progress) {
  FilesTogether written(settings.folder);
  for (int frame = 0; frame < settings.frames; ++frame) {
    progress.next();
    const auto picture = drawn(frame);
    if (!picture) return false;
    written.add(frameName(frame), [&](const auto& png) { writePng(*picture, png); });
  }
  written.commit();
  return true;
}

/// False where it was stopped.
bool drawGif(const LoadPathAnimation::Settings& settings, const Drawn& drawn, FrameProgress& progress,
             const std::stop_token& stop) {
  requireWritable(settings.gif, true); // a file that cannot be written is reported before the work
  const int last = settings.frames - 1;
  std::map<int, Picture> typical; // for the palette; they are not drawn twice
  for (const int frame : {0, last / 2, last}) {
    if (typical.contains(frame)) continue;
    progress.next();
    auto picture = drawn(frame);
    if (!picture) return false;
    typical.emplace(frame, std::move(*picture));
  }
  std::vector<Picture> pictures;
  for (const auto& [frame, picture] : typical) pictures.push_back(picture);
  GifFilm film(pictures);
  int shown = 0; // hundredths of a second, rounded over the complete film
  for (int frame = 0; frame < settings.frames; ++frame) {
    auto picture = typical.contains(frame) ? std::optional(typical.at(frame)) : std::nullopt;
    if (!picture) {
      progress.next();
      picture = drawn(frame);
    }
    if (!picture || stop.stop_requested()) return false;
    const int until = static_cast<int>(std::lround(100 * settings.seconds * (frame + 1) / settings.frames));
    film.add(*picture, until - shown);
    shown = until;
  }
  writeFile(settings.gif, film.finish(), true);
  return true;
}

QString filmSentence(const LoadPathAnimation::Settings& settings) {
  if (!settings.gif.empty())
    return QObject::tr("Wrote %1: %2 pictures, %3 s, %4 MB.")
        .arg(QString::fromStdString(settings.gif.string()))
        .arg(settings.frames)
        .arg(settings.seconds)
        .arg(static_cast<double>(std::filesystem::file_size(settings.gif)) / 1e6, 0, 'g', 2);
  return QObject::tr("Wrote %1 pictures, %2. A program such as ffmpeg turns them into a film; run in their folder: "
                     "ffmpeg -framerate %3 -i ")
             .arg(settings.frames)
             .arg(QString::fromStdString((settings.folder / "load-*.png").string()))
             .arg(settings.frames / settings.seconds, 0, 'g', 4) +
         "load-%03d.png film.mp4";
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
  const Path* of = nullptr; ///< what it has drawn
};

/// The computed touch and its states; shared with the job.
struct LoadPathAnimation::Path {
  Touch touch;
  std::vector<LoadPathState> states;
};

/// A picture requested from the window by the job, which waits for it.
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
  const auto work = [this, settings, touch = session_.touch()](const std::stop_token& stop,
                                                               JobProgress& progress) -> JobRunner::Taking {
    auto path = std::make_shared<Path>(Path{touch, {}});
    progress.set(-1, "Fields along the load path");
    path->states = loadPathStates(touch, stop);
    throwIfStopped(stop);
    // One colour scale over the complete path.
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
    if (!fixed.options.deformationScale)
      fixed.options.deformationScale =
          automaticDeformationScale(touch.design(), path->states.back().fields.displacement_mm);
    const double last = path->states.back().fraction;
    const auto drawn = [&](int frame) -> std::optional<Picture> {
      auto order = std::make_shared<Order>();
      order->path = path;
      order->settings = fixed;
      order->state = stateAt(path->states, last * frame / std::max(settings.frames - 1, 1));
      if (!drawInWindow(order, stop)) return {};
      if (!order->problem.empty()) throw Error(order->problem);
      return std::move(order->picture);
    };
    FrameProgress counted(progress, settings.frames);
    const bool whole =
        settings.gif.empty() ? drawPictures(settings, drawn, counted) : drawGif(settings, drawn, counted, stop);
    if (!whole) throw Cancelled();
    return [this, sentence = filmSentence(settings)] { emit done(sentence); };
  };
  runner_.start(tr("Drawing the load path"), work, JobRunner::Loss::Work);
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
    picture = draw(*order.path, order.settings, order.state);
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

Picture LoadPathAnimation::draw(const Path& path, const Settings& settings, const LoadPathState& now) {
  requireDrawable(settings.width, settings.height);
  if (!easel_ || easel_->of != &path) { // begins a film
    easel_.reset();
    easel_ = std::make_unique<Easel>();
  }
  DeformationScene& scene = easel_->scene;
  const SensorDesign& design = path.touch.design();
  DeformationState state{&design,      path.touch.mesh(), &now.fields, &now.electrodes, &path.touch.load(),
                         now.fraction, now.indenters};
  std::optional<LoadPathState> less;
  if (settings.kept) {
    state.referenceDesign = &settings.kept->design;
    state.keptLoad = &settings.kept->load;
    state.kept = &less.emplace(settings.kept->at(now.fraction)).fields;
  }
  scene.show(state, settings.options, easel_->of == nullptr);
  if (easel_->of == nullptr) {
    easel_->window.setSize(settings.width, settings.height);
    easel_->window.vtk()->AddRenderer(scene.renderer());
    scene.renderer()->GetActiveCamera()->DeepCopy(view_.camera());
    easel_->of = &path;
  }
  scene.renderer()->ResetCameraClippingRange();
  easel_->window.render();
  return easel_->window.picture();
}

} // namespace palp
