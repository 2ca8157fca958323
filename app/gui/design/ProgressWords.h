#pragma once

#include <QString>

class QLabel;

namespace palp {

class JobRunner;

/// The label says what the runner is at: "Being computed, 40 %: response of area 3 of 6, about 20 s left".
void sayProgress(JobRunner& runner, QLabel& label);

} // namespace palp
