#pragma once

#include "app/gui/jobs/FieldTouch.h"
#include "app/scenes/block/current/CurrentLines.h"

#include <array>

namespace palp {

/// The current paths in a touch while one row-wire and one column-wire are read, in the background and only while a
/// scene shows it.
class CurrentPathsJob : public QObject {
  Q_OBJECT

public:
  explicit CurrentPathsJob(FieldTouch& field, QObject* parent = nullptr);

  /// A scene shows it: computed unless that was done, or runs, as soon as the field of the state was found.
  void want(const Touch& touch, double loadFraction, const std::array<int, 2>& cell);
  /// Null before it is there, and where another one was wanted last.
  [[nodiscard]] const CurrentLines* lines() const { return lines_.get(); }
  /// Why there is none; empty while it is computed.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// Nothing is wanted any more.
  void leave();
  [[nodiscard]] JobRunner& runner() { return runner_; }
  /// How many were computed.
  [[nodiscard]] int runs() const { return runs_; }

signals:
  void changed();

private:
  /// What it is known by.
  struct Wanted {
    std::shared_ptr<const FieldFound> state;
    Readout readout;
    std::array<int, 2> cell;
    bool operator==(const Wanted&) const = default;
  };

  FieldTouch& field_;
  JobRunner runner_;
  std::optional<Wanted> wanted_;
  std::shared_ptr<const CurrentLines> lines_;
  QString problem_;
  int runs_ = 0;
};

} // namespace palp
