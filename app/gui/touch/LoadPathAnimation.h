#pragma once

#include "app/gui/jobs/ReferenceTouch.h"
#include "app/scenes/Picture.h"
#include "app/scenes/block/DeformationScene.h"

#include <filesystem>

namespace palp {

class BlockView;
class TouchSession;

/// The path from rest to the full load as an animated GIF or a series of pictures, with one deformation scale and one
/// colour scale throughout. Fields between two computed equilibria are interpolated; they and the files are made in the
/// background, the pictures drawn in the window's thread, one an event. What is stopped or cannot be written leaves no
/// part of a film.
class LoadPathAnimation : public QObject {
  Q_OBJECT

public:
  struct Settings {
    DeformationOptions options;
    std::shared_ptr<const ReferencePath> kept; ///< that the colours are less of; null: of none
    int frames = 25;
    int width = 1200;
    int height = 800;
    double seconds = 4;           ///< that the film lasts
    std::filesystem::path gif;    ///< the film; empty: pictures
    std::filesystem::path folder; ///< else: gets load-000.png, load-001.png, ...; made where it is not there
  };

  /// Looks at the block as `view` does.
  LoadPathAnimation(const TouchSession& session, const BlockView& view, QObject* parent = nullptr);
  ~LoadPathAnimation() override;

  /// False where there is nothing to show yet.
  bool start(const Settings& settings);
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void done(const QString& sentence);

private:
  struct Easel;
  struct Path;
  struct Order;
  [[nodiscard]] Picture draw(const Path& path, const Settings& settings, const LoadPathState& now);
  void fill(Order& order);
  /// False where it was stopped first.
  [[nodiscard]] bool drawInWindow(const std::shared_ptr<Order>& order, const std::stop_token& stop);

  const TouchSession& session_;
  const BlockView& view_;
  std::unique_ptr<Easel> easel_;              ///< of the run; only touched in the window's thread
  JobRunner runner_{JobRunner::Orders::Each}; ///< films are drawn one after the other
};

} // namespace palp
