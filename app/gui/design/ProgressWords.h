#pragma once

#include <QString>

class QLabel;

namespace palp {

class JobRunner;

/// The label shows the progress of the runner: "Computing, 40 %: response of area 3 of 6, about 20 s left".
void showProgress(JobRunner& runner, QLabel& label);

} // namespace palp
