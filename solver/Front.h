#pragma once

#include "solver/LaneVector.h"

#include <functional>

namespace palp {

/// Runs tasks 0 .. count - 1, perhaps in parallel; false where they were stopped.
using TaskRunner = std::function<bool(int count, double flops, const std::function<void(int)>&)>;

/// The lower triangle, by columns, that a supernode hands to its parent.
struct UpdateMatrix {
  int size = 0;
  UnsetArray values; ///< size x size
};

enum class FrontOutcome { Done, NotPositiveDefinite, Stopped };

/// Factorises a panel of height x width in place; the update becomes -L21 L21^T.
FrontOutcome factoriseFront(double* panel, int height, int width, UpdateMatrix& update, const TaskRunner& run);

/// BLAS at one thread from here on: how its sums are cut depends on the number of threads.
void useOneBlasThread();

/// x := L^-1 x and x := L^-T x for the lower triangle at the panel's top; y -= L21 x and x -= L21^T y for the rest.
void forwardPanel(const double* panel, int height, int width, double* x, double* y);
void backwardPanel(const double* panel, int height, int width, double* x, const double* y);

} // namespace palp
