#include "solver/batch/LaneMixing.h"

#include <algorithm>

namespace palp {

LaneMixing::LaneMixing(std::size_t leading, std::size_t following)
    : leading_(leading * batchLanes), following_(following * batchLanes), changes_(leading * batchLanes) {}

void LaneMixing::begin(int lane, bool mixed) {
  mixed_[lane] = mixed;
  restarts_[lane] = false;
  iterations_[lane] = 0;
}

/// The normal equations of the least squares for gamma are at most 2 x 2.
void LaneMixing::mixLeading(const std::array<bool, batchLanes>& moved, double* directions) {
  struct Lane {
    int index = 0, known = 0, slot = 0; ///< this iteration's change goes to the slot
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
  };
  std::vector<Lane> some;
  for (int l = 0; l < batchLanes; ++l)
    if (mixed_[l] && moved[l]) {
      if (restarts_[l]) iterations_[l] = 0; // only now: what followed the last directions has been mixed
      restarts_[l] = false;
      const int before = iterations_[l]++;
      some.push_back({l, std::min(before, depth), before % depth});
    }
  const std::size_t rows = leading_.size() / batchLanes;
  for (std::size_t row = 0; row < rows; ++row)
    for (Lane& lane : some) {
      const std::size_t i = row * batchLanes + lane.index;
      const double r = directions[i];
      Past& past = leading_[i];
      if (lane.known > 0) {
        const double a = r - past.direction, b = lane.known > 1 ? changes_[i][1 - lane.slot] : 0.F;
        changes_[i][lane.slot] = static_cast<float>(a);
        past.motion[lane.slot] = static_cast<float>(past.step + a);
        lane.aa += a * a;
        lane.ab += a * b;
        lane.bb += b * b;
        lane.ra += r * a;
        lane.rb += r * b;
      }
      past.direction = static_cast<float>(r);
    }
  for (const Lane& lane : some) {
    double a = 0, b = 0;
    const double determinant = lane.aa * lane.bb - lane.ab * lane.ab;
    constexpr double independent = 1e-8; // changes whose directions differ by less are one
    if (lane.known > 1 && determinant > independent * lane.aa * lane.bb) {
      a = (lane.ra * lane.bb - lane.rb * lane.ab) / determinant;
      b = (lane.rb * lane.aa - lane.ra * lane.ab) / determinant;
    } else if (lane.aa > 0) {
      a = lane.ra / lane.aa;
    }
    gamma_[lane.index][lane.slot] = a;
    gamma_[lane.index][1 - lane.slot] = b;
  }
  for (std::size_t row = 0; row < rows; ++row)
    for (const Lane& lane : some) {
      const std::size_t i = row * batchLanes + lane.index;
      Past& past = leading_[i];
      if (lane.known > 0) directions[i] -= gamma_[lane.index][lane.slot] * past.motion[lane.slot];
      if (lane.known > 1) directions[i] -= gamma_[lane.index][1 - lane.slot] * past.motion[1 - lane.slot];
      past.step = static_cast<float>(directions[i]);
    }
}

double LaneMixing::mixFollowing(int lane, std::size_t index, double direction) {
  Past& past = following_[index * batchLanes + lane];
  const int before = iterations_[lane] - 1; // mixLeading has counted this one
  const int known = std::min(before, depth), slot = before % depth;
  if (known > 0) past.motion[slot] = static_cast<float>(past.step + direction - past.direction);
  past.direction = static_cast<float>(direction);
  if (known > 0) direction -= gamma_[lane][slot] * past.motion[slot];
  if (known > 1) direction -= gamma_[lane][1 - slot] * past.motion[1 - slot];
  past.step = static_cast<float>(direction);
  return direction;
}

} // namespace palp
