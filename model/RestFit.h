#pragma once

#include "model/SensorDesign.h"

#include <Eigen/Core>

#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// What the resistances of a sensor at rest say about its electrodes and its rubber.
struct RestFit {
  FieldLaw law; ///< with the fitted radius, resistivity and contact; the rest as given
  // Standard deviations from the covariance of the fit, of what was fitted: by the noise of the readings or by what the
  // fit leaves of them, whichever is larger.
  double radiusDeviation_mm = 0;
  double resistivityDeviation_ohm_mm = 0;
  double contactDeviation_ohm_mm2 = 0; ///< 0: kept, see keptContact
  double correlation = 0;              ///< of ln radius with the contact's share, where both were fitted
  std::string keptContact;             ///< reason why the contact was not fitted; empty where it was
  double misfit = 0;                   ///< rms residual of ln R
  Eigen::MatrixXd left;                ///< ln R of the sensor less that of the fit; NaN where there is no reading
  int readings = 0;
};

/// Residual of ln R (rms) above which a fit is rejected: positions accurate to 0.05 mm leave less.
inline constexpr double kRestFits = 0.02;

/// Fits electrode radius, resistivity and contact of a design under the field to R at rest, in closed form: Green's
/// function of the box is computed once; the three numbers enter P by its diagonal and the dipoles alone.
/// `resistances_ohm` row-wires x column-wires, NaN where one is unknown; `noise` of a reading, relative. The contact
/// and the radius differ only in their dipoles: where the readings cannot distinguish them, the contact is kept. Throws
/// Error where the design does not have the law of the field, a reading is not a resistance, or there are too few
/// readings, and Cancelled.
RestFit fitAtRest(const SensorDesign& design, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm, double noise,
                  const std::stop_token& stop = {});

/// Why a fit cannot be trusted, in a sentence that names the wire or the read-out that is likely to blame; empty where
/// it can. Tries the other read-outs. Throws Cancelled.
std::string whyNoFit(const RestFit& fit, const SensorDesign& design,
                     const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm, double noise,
                     const std::stop_token& stop = {});

} // namespace palp
