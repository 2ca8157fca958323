#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include "app/study/decoding/NoiseBound.h"
#include "app/study/reports/map/TouchBound.h"

#include <QString>

#include <array>

namespace palp {

/// The errors of each force and, where positions were learned, along x and y, as a table of rich text: with the bound
/// of the same noise (null: not known yet) and the network that was shown before. "-" where there is nothing to learn.
QString errorTable(const NetworkSession& session, const NetworkFit& fit, const NoiseBound* bound, const QString& title);

/// Less the errors of forces that were 0 in all samples that it was trained with: it did not learn them.
Eigen::VectorXd ofForces(Eigen::VectorXd errors, const Decoder& decoder);
/// The same by these samples; null: all of them.
Eigen::VectorXd ofForces(Eigen::VectorXd errors, const NetworkSamples* samples);

/// Root mean square errors of forces [N] and places [mm] on the test samples; empty where there are none.
struct RootMeanSquares {
  Eigen::VectorXd forces_N, places_mm;
};
/// {of the network, of always predicting the mean of the training samples}.
std::array<RootMeanSquares, 2> againstAGuess(const NetworkSamples& samples, const NetworkFit& fit);

/// The outputs in which the network is worse than such a prediction, as a line of rich text; empty where there are
/// none.
QString guessWords(const NetworkSession& session, const NetworkFit& fit);

QString placeWords(const NetworkFit& fit);

/// The errors of a network of force and position compared with the bound of unbiased estimates.
QString boundWords(const NetworkSession& session, const NetworkFit& fit, const SampleBounds* touches);

/// Statistical error of a root mean square over this many test samples.
QString scatterWords(const NetworkSession& session, const NetworkFit& fit);

/// What a result calls for.
QString adviceWords(const NetworkSession& session, const NetworkFit& fit);

/// What palp train warns of on the command line, a line each.
QString warningWords(const NetworkFit& fit);

} // namespace palp
