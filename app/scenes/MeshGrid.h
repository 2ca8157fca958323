#pragma once

#include "model/Mesh.h"

#include <Eigen/Core>

#include <string>

class vtkUnstructuredGrid;

namespace palp {

/// The mesh as VTK's grid, its nodes (3 x nodes [mm]) where they are drawn.
void fillGrid(vtkUnstructuredGrid& grid, const Mesh& mesh, const Eigen::Ref<const Eigen::Matrix3Xd>& drawn_mm);

/// Values at the grid's nodes, components x nodes, under a name.
void addNodalArray(vtkUnstructuredGrid& grid, const std::string& name, const Eigen::Ref<const Eigen::MatrixXd>& values);

} // namespace palp
