#pragma once

#include <QObject>

#include <filesystem>
#include <memory>
#include <vector>

class QWidget;

namespace palp {

class NetworkSession;
struct NetworkSamples;
class Workbench;

/// Asks which files: samples and networks opened and saved, and a network that is saved for Live.
class NetworkFiles : public QObject {
  Q_OBJECT

public:
  /// Questions are shown above `page`, which owns it.
  NetworkFiles(Workbench& workbench, NetworkSession& session, QWidget* page);

  void openSamples();
  /// Tables that are not samples are imported.
  void openSamples(const std::vector<std::filesystem::path>& files);
  void chooseTables();
  void saveSamples();
  void openNetwork();
  void saveNetwork();
  /// Live decodes with the network that is shown as soon as it is saved.
  void useInLive();

signals:
  void problem(const QString& sentence);
  void sceneRequested(const QString& scene);
  void importRequested(const QStringList& tables);
  /// The file of the network that Live decodes with holds another one.
  void liveNetworkReplaced();

private:
  void openChosen(const QStringList& chosen);
  void takeIntoLive(const std::filesystem::path& network);
  [[nodiscard]] QString proposedName() const;
  /// Samples that took long and are in no file are not replaced silently.
  [[nodiscard]] bool mayReplaceSamples() const;

  Workbench& workbench_;
  NetworkSession& session_;
  QWidget* page_;
  std::weak_ptr<const NetworkSamples> saved_; ///< in files of their own
};

} // namespace palp
