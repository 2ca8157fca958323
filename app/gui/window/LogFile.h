#pragma once

#include <QObject>

#include <mutex>

namespace palp {

/// The window's messages on disk, a line each with date and time: what an experimenter can send after a night.
/// One file for all windows of a user, palp-studio.log; beyond 1 MB it becomes palp-studio.log.1, which replaces the
/// one before. Lines may come from any thread.
class LogFile : public QObject {
  Q_OBJECT

public:
  /// Makes the folder. An empty one: nothing is kept.
  explicit LogFile(const QString& folder, QObject* parent = nullptr);
  ~LogFile() override;
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  void add(const QString& sentence);
  /// Takes Qt's own warnings too, as long as this object lives; they still go to standard error. One log at a time.
  void takeQtMessages();
  [[nodiscard]] QString path() const { return path_; }
  /// log, in the folder where the window keeps unsaved work.
  static QString standardFolder();

signals:
  /// Once: from then on nothing is kept.
  void failed(const QString& why);

private:
  /// Why the line could not be written; empty where it was.
  QString write(const QByteArray& line);

  QString path_;
  std::mutex writing_;
  bool works_ = false;
};

} // namespace palp
