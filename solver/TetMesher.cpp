#include "solver/TetMesher.h"

#include "model/Error.h"

#include <tetgen.h>

#include <algorithm>
#include <string>

namespace palp {

namespace {

void setFacet(tetgenio::facet& out, const Facet& facet) {
  tetgenio::init(&out);
  out.numberofpolygons = 1;
  out.polygonlist = new tetgenio::polygon[1];
  tetgenio::init(out.polygonlist);
  out.polygonlist->numberofvertices = static_cast<int>(facet.corners.size());
  out.polygonlist->vertexlist = new int[facet.corners.size()];
  std::copy(facet.corners.begin(), facet.corners.end(), out.polygonlist->vertexlist);
}

/// TetGen's input; its destructor frees the arrays.
void fill(tetgenio& in, const Eigen::Matrix3Xd& points, const std::vector<Facet>& facets) {
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(points.cols());
  in.pointlist = new REAL[points.size()];
  std::copy(points.data(), points.data() + points.size(), in.pointlist);
  in.numberoffacets = static_cast<int>(facets.size());
  in.facetlist = new tetgenio::facet[facets.size()];
  in.facetmarkerlist = new int[facets.size()];
  for (std::size_t f = 0; f < facets.size(); ++f) {
    setFacet(in.facetlist[f], facets[f]);
    in.facetmarkerlist[f] = facets[f].mark;
  }
}

} // namespace

LinearTets tetrahedralise(const Eigen::Matrix3Xd& points, const std::vector<Facet>& facets, double largestVolume) {
  tetgenio in, out;
  fill(in, points, facets);
  // Radius-edge ratio 1.3, dihedral angles above 12 degrees, full optimisation, quiet.
  std::string switches = "pq1.3/12O4/7Qa" + std::to_string(largestVolume);
  try {
    tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    throw DesignError("mesh: TetGen cannot mesh this block (its error code " + std::to_string(code) + ")");
  }
  LinearTets tets;
  tets.points = Eigen::Map<Eigen::Matrix3Xd>(out.pointlist, 3, out.numberofpoints);
  tets.corners = Eigen::Map<Eigen::Matrix4Xi>(out.tetrahedronlist, 4, out.numberoftetrahedra);
  for (Eigen::Index e = 0; e < tets.corners.cols(); ++e) std::swap(tets.corners(0, e), tets.corners(1, e));
  tets.faces = Eigen::Map<Eigen::Matrix3Xi>(out.trifacelist, 3, out.numberoftrifaces);
  tets.faceMarks.assign(out.trifacemarkerlist, out.trifacemarkerlist + out.numberoftrifaces);
  return tets;
}

} // namespace palp
