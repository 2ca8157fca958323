#pragma once

#include <QJsonArray>
#include <QObject>
#include <QString>

#include <functional>
#include <map>

namespace palp {

class MainWindow;
class Workbench;

/// Drives the window through its scenes and measures what each step costs: stages run, seconds, memory, pictures drawn
/// in the scene that is seen, and whatever is drawn in those that are not. Spins the event loop until a step is over.
class SceneCosts : public QObject {
public:
  SceneCosts(MainWindow& window, Workbench& workbench);

  /// One scene: opened, left alone, given another load, material, lower and upper layer; then hidden, given another
  /// load, and seen again. A window that was not yet seen is shown; its opening counts from the program's start.
  QJsonArray oneScene(const QString& name);
  /// All scenes in turn, twice, with nothing changed.
  QJsonArray allScenes();

protected:
  /// Counts the paintings of each scene's widgets.
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  /// Makes the change and waits until the work and its pictures are done, or exactly so long where that is not 0.
  QJsonObject step(const QString& event, const std::function<void()>& change, double exactly_s = 0);
  /// Seconds until the last of the work and its picture.
  double settle();
  [[nodiscard]] bool waitsToDraw() const;
  [[nodiscard]] std::map<QString, int> drawings() const;

  MainWindow& window_;
  Workbench& workbench_;
  std::map<QString, int> paintings_; ///< of the widgets of each scene
};

/// Prints the costs of a scene, or of all in turn where the name is empty, as one JSON object: `scenes`, `window_px`,
/// `steps`. For palp report scenes.
void printSceneCosts(MainWindow& window, Workbench& workbench, const QString& scene);

} // namespace palp
