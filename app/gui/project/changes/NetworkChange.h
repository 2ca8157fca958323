#pragma once

#include "app/gui/project/Project.h"
#include "app/study/decoding/TrainOptionTable.h"

#include <QString>
#include <QStringList>

namespace palp {

/// "spread 1 -> 0.5", "block size along x 30 -> 45.5 mm": values that are long are cut.
QString stepWords(const QString& name, const QString& from, const QString& to, const QString& unit = {});

/// An option's value in a sentence: "svd", "0.01 %"; where it is not set, that the mode decides.
QString optionWords(const TrainOption& option, const TrainOptions& options);

/// What changed in the network, its sweep and its training, a sentence each.
QStringList networkChanges(const NetworkSettings& before, const NetworkSettings& after);

/// What changed in the samples that are to be made, a sentence each; a single empty one where that is too many.
QStringList sampleChanges(const SampleSettings& before, const SampleSettings& after);

} // namespace palp
