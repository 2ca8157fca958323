#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include "app/study/decoding/NoiseBound.h"
#include "app/study/reports/map/TouchBound.h"

#include <QString>

#include <vector>

namespace palp {

/// Three numbers and their unit: "1.2 / 3 / 0.5 %".
QString triple(const Eigen::VectorXd& values, const QString& unit);

/// What was set that otherwise follows from the mode, but for ridge, scaler and seed: "tail bias, solver svd".
QString optionsWords(const NetworkSettings& settings);
/// The ridge, and whether it was chosen by the samples: "1e-05 (by leave-one-out)".
QString ridgeWords(const NetworkFit& fit);
/// How its inputs are scaled, set or from the mode; "-" where that is unknown.
QString scalerWords(const NetworkFit& fit);

/// Where a network comes from and how it was trained: "from displacements, rows 4, rbf, default, 600 centres".
QString originWords(const NetworkFit& fit);

/// Why the network that is shown does not belong to what is set now; empty where it does.
QString staleReason(const NetworkSession& session, const NetworkSettings& now);
/// The same for the points of the sweep.
QString staleSweepReason(const NetworkSession& session, const NetworkSettings& now);
/// The same for the comparison of decoders.
QString staleTrialsReason(const NetworkSession& session, const NetworkSettings& now);
/// The same for the list of networks, each with its training options.
QString staleListReason(const NetworkSession& session);

/// What the comparison was made with, and who is missing in it.
QString trialsWords(const NetworkSession& session, const NetworkSettings& now);

/// "an earlier design", and what has changed of it since.
QString earlierDesign(const NetworkSession& session);

/// The sweep was made as the comparison was, but for the decoder and the spread.
bool sweepAndTrialsAgree(const NetworkSession& session);

/// The network that is shown and its errors as rich text, with the bound of the same noise (null: unknown yet) and
/// the network before it; grey with the reason where it is stale. `touches`: the bounds at each touch of the test;
/// null: not known, or not yet.
QString fitWords(const NetworkSession& session, const NetworkSettings& now, const NoiseBound* bound,
                 const SampleBounds* touches = nullptr);

} // namespace palp
