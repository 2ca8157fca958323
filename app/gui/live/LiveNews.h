#pragma once

#include "app/gui/live/LiveHost.h"

#include <QStringList>

namespace palp {

/// What happens to a board, each event said once, for the log of messages: it goes and comes back, a wire breaks or is
/// mended, the sensor drifts, a tare begins to hold or is cleared. Of a recording nothing: it is no news.
class LiveNews {
public:
  /// After each look of the host: what happened since the last one.
  QStringList take(const LiveHost& host);

private:
  void takeWires(const LiveHost& host, QStringList& news);
  void takeRest(const LiveStatus& status, QStringList& news);

  int openings_ = 0;
  bool known_ = false; ///< of this source: what it was at first is no news
  bool gone_ = false;
  bool drifted_ = false;
  std::vector<std::string> faults_;
  std::shared_ptr<const Tare> tare_;
};

/// What the drift of a sensor asks for, in a sentence; empty where it asks for nothing.
QString driftWords(const LiveStatus& status);

} // namespace palp
