#pragma once

#include "app/gui/live/LiveHost.h"

#include <QStringList>

namespace palp {

/// Events of a board, each reported once, for the log of messages: another source, a board that is unplugged and comes
/// back, a wire that breaks or is mended, a drift, a tare that holds or is cleared, another network. Of what is played
/// only the start is reported.
class LiveNews {
public:
  /// After each look of the host: what happened since the last one.
  QStringList take(const LiveHost& host);

private:
  void takeSource(const LiveHost& host, QStringList& news);
  void takeWires(const LiveHost& host, QStringList& news);
  void takeRest(const LiveStatus& status, QStringList& news);

  int openings_ = 0;
  bool known_ = false; ///< of this source: its initial state is not reported
  bool gone_ = false;
  double drifted_s_ = 0;                    ///< host clock when a drift was last reported; 0: not since the tare
  std::vector<std::string> faults_, fresh_; ///< reported; those of the last look
  double freshSince_s_ = 0;                 ///< host clock
  std::shared_ptr<const Tare> tare_;
  QString network_;
  QString recordingFailure_;
};

/// What the drift of a sensor asks for, in a sentence; empty where it asks for nothing.
QString driftWords(const LiveStatus& status);

/// The network in use: name, decoder, wires, noise.
QString networkWords(const LiveHost& host);

} // namespace palp
