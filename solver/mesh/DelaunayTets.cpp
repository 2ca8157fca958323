#include "solver/mesh/DelaunayTets.h"

#include "model/DesignError.h"

#include <tetgen.h>

#include <algorithm>
#include <string>

namespace palp {

LinearTets weightedDelaunay(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights) {
  tetgenio in, out; // their destructors free the arrays
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(points.cols());
  in.numberofpointattributes = 1;
  in.pointlist = new REAL[points.size()];
  in.pointattributelist = new REAL[weights.size()];
  std::copy(points.data(), points.data() + points.size(), in.pointlist);
  std::copy(weights.data(), weights.data() + weights.size(), in.pointattributelist);
  std::string switches = "wQ"; // weighted, quiet
  try {
    tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    throw DesignError("mesh: TetGen cannot mesh this block (its error code " + std::to_string(code) + ")");
  }
  LinearTets tets;
  tets.corners = Eigen::Map<Eigen::Matrix4Xi>(out.tetrahedronlist, 4, out.numberoftetrahedra);
  tets.hull = Eigen::Map<Eigen::Matrix3Xi>(out.trifacelist, 3, out.numberoftrifaces);
  return tets;
}

} // namespace palp
