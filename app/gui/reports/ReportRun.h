#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QProcess>

namespace palp {

/// A run of palp as a separate process: its messages, its progress and how it ended.
class ReportRun : public QObject {
  Q_OBJECT

public:
  enum class Ending { Done, Cancelled, NoResult, Failed, NotStarted };

  explicit ReportRun(QObject* parent = nullptr);
  ~ReportRun() override;

  void start(const QString& program, const QStringList& arguments);
  void cancel();
  /// Ends it within seconds, without a message.
  void kill();
  [[nodiscard]] bool running() const { return process_.state() != QProcess::NotRunning; }
  [[nodiscard]] double seconds() const { return 1e-3 * static_cast<double>(clock_.elapsed()); }
  /// Of the program, after it failed.
  [[nodiscard]] int status() const { return process_.exitCode(); }

signals:
  void said(const QString& line);
  /// Share 0..1 of the run, and what is being done.
  void progressed(double share, const QString& what);
  void ended(palp::ReportRun::Ending how);

private:
  void read();
  void say(const QString& line);
  void end(int status, QProcess::ExitStatus how);

  QProcess process_;
  QElapsedTimer clock_;
  bool cancelled_ = false;
};

} // namespace palp
