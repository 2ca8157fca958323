#pragma once

#include <QObject>
#include <QString>
#include <QTimer>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

namespace palp {

/// Where a job stands; written by the job, read by the window's timer.
class JobProgress {
public:
  /// Share 0..1 of the work, or below 0 where it is not known, and what is being done. From any thread.
  void set(double share, const std::string& what);

private:
  friend class JobRunner;
  struct Values {
    double share = -1;
    std::string what;
  };
  [[nodiscard]] Values values() const;

  mutable std::mutex mutex_;
  Values values_;
};

/// Runs one piece of work at a time off the window's thread; a new one stops and replaces the one before. Whatever the
/// work or the taking of its result throws comes out as a sentence, and nothing passes on.
class JobRunner : public QObject {
  Q_OBJECT

public:
  /// What the window does with the result, in its own thread.
  using Taking = std::function<void()>;
  /// The work, on copies of its inputs; it ends within 0.3 s of a stop and may return an empty Taking.
  using Work = std::function<Taking(const std::stop_token&, JobProgress&)>;

  explicit JobRunner(QObject* parent = nullptr);
  ~JobRunner() override;

  void start(const QString& title, Work work);
  /// Stops what runs and what waits; what the work returns then is not taken.
  void cancel();
  [[nodiscard]] bool running() const { return thread_.joinable(); }
  [[nodiscard]] const QString& title() const { return title_; }

signals:
  void started(const QString& title);
  /// A few times a second while work runs; share below 0 where it is not known.
  void progressed(double share, const QString& what);
  void failed(const QString& sentence);
  /// Nothing runs and nothing waits.
  void finished(bool cancelled);

private:
  struct Order {
    QString title;
    Work work;
  };
  void launch(Order order);
  void end(const Taking& taking, const QString& error);
  void report();

  std::jthread thread_;
  std::optional<Order> waiting_;
  QString title_;
  bool cancelled_ = false;
  std::shared_ptr<JobProgress> progress_;
  QTimer timer_;
};

} // namespace palp
