#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>

namespace palp {

/// The progress of a job; written by the job, read by the window's timer.
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

/// Runs one piece of work at a time off the window's thread. Whatever the work or the taking of its result throws comes
/// out as a sentence, and nothing passes on.
class JobRunner : public QObject {
  Q_OBJECT

public:
  /// What the window does with the result, in its own thread.
  using Taking = std::function<void()>;
  /// The work, on copies of its inputs; it ends within 0.3 s of a stop and may return an empty Taking.
  using Work = std::function<Taking(const std::stop_token&, JobProgress&)>;

  enum class Orders {
    Newest, ///< to compute: a new order stops and replaces the one before
    Each,   ///< to write: every order is carried out in its turn, and its end is reported
  };

  explicit JobRunner(QObject* parent = nullptr) : JobRunner(Orders::Newest, parent) {}
  explicit JobRunner(Orders orders, QObject* parent = nullptr);
  ~JobRunner() override;

  /// What it is to the user that the work ends early.
  enum class Loss {
    None, ///< it is done again where it is needed
    Work  ///< what it has made is lost: leaving asks first
  };

  void start(const QString& title, Work work, Loss loss = Loss::None);
  /// Newest: stops the running work, drops the waiting one; what the work returns then is not taken. Each: drops the
  /// waiting orders; the running one may end with Cancelled, or complete and be taken.
  void cancel();
  [[nodiscard]] Orders orders() const { return orders_; }
  [[nodiscard]] bool running() const { return thread_.joinable(); }
  [[nodiscard]] const QString& title() const { return title_; }
  /// It runs, and what it has made would be lost: in a sentence; else empty.
  [[nodiscard]] QString loss() const;

signals:
  void started(const QString& title);
  /// A few times a second while work runs; share below 0 where it is not known.
  void progressed(double share, const QString& what);
  void failed(const QString& sentence);
  /// An order that was cancelled before it began, or ended with Cancelled (Orders::Each).
  void dropped(const QString& title);
  /// Nothing runs and nothing waits. Cancelled: the last result was not taken (Orders::Newest).
  void finished(bool cancelled);

private:
  struct Order {
    QString title;
    Work work;
    Loss loss = Loss::None;
  };
  struct Ending {
    Taking taking;
    QString error;
    bool cancelled = false; ///< by the work itself
  };
  void launch(Order order);
  void end(const Ending& ending);
  void report();

  Orders orders_;
  std::jthread thread_;
  std::deque<Order> waiting_;
  QString title_;
  Loss loss_ = Loss::None;
  bool cancelled_ = false;
  std::shared_ptr<JobProgress> progress_;
  QTimer timer_;
};

} // namespace palp
