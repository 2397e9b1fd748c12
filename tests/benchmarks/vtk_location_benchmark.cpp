// SPDX-License-Identifier: GPL-3.0-or-later
// vtk_location_benchmark MESH.h5 [BALLS]: locates the same points by VTK's static cell locator and by
// averaging's CellLocator in a mesh of hexahedra.
#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "averaging/mesh/mesh_file.hpp"
#include "tests/benchmarks/location_comparison.hpp"

namespace {

using namespace millfoam::averaging;

using Quadrangle = std::array<int, 4>;

/// A cell's faces of four points, each as seen from outside.
std::vector<Quadrangle> faces_of(const MeshGeometry& geometry, int cell) {
  const MeshTopology& topology = geometry.topology();
  std::vector<Quadrangle> faces;
  const auto [begin, end] = geometry.faces_of(cell);
  for (const int* f = begin; f != end; ++f) {
    const auto face = static_cast<std::size_t>(*f);
    const auto first = topology.face_points.begin() + topology.face_begin[face];
    if (topology.face_begin[face + 1] - topology.face_begin[face] != 4) break;
    Quadrangle points{first[0], first[1], first[2], first[3]};
    if (topology.owner[face] != cell) std::reverse(points.begin(), points.end());
    faces.push_back(points);
  }
  if (faces.size() != 6) throw std::invalid_argument("cell " + std::to_string(cell) + " is not a hexahedron");
  return faces;
}

/// The cell's point that an edge leads to from `point` of `base` and that is not in `base`.
vtkIdType point_over(int point, const Quadrangle& base, const std::vector<Quadrangle>& faces) {
  for (const Quadrangle& face : faces) {
    const auto at = std::find(face.begin(), face.end(), point) - face.begin();
    if (at == 4) continue;
    const int next = face[static_cast<std::size_t>((at + 1) % 4)];
    if (std::find(base.begin(), base.end(), next) == base.end()) return next;
  }
  throw std::invalid_argument("a cell of six quadrangles is not a hexahedron");
}

vtkNew<vtkUnstructuredGrid> grid_of(const MeshGeometry& geometry) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t p = 0; p < geometry.topology().points; ++p)
    points->InsertNextPoint(geometry.points()[p].data());
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  for (int cell = 0; cell < static_cast<int>(geometry.cells()); ++cell) {
    const auto faces = faces_of(geometry, cell);
    // VTK's base looks into the cell.
    const Quadrangle base{faces[0][3], faces[0][2], faces[0][1], faces[0][0]};
    std::array<vtkIdType, 8> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i] = base[i];
      corners[i + 4] = point_over(base[i], base, faces);
    }
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
  }
  return grid;
}

/// @param cells_per_bin  of the locator's grid; VTK takes 10 by default
Located locate_by_vtk(vtkUnstructuredGrid* grid, const std::vector<Eigen::Vector3d>& points,
                      int cells_per_bin) {
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(grid);
  locator->SetNumberOfCellsPerNode(cells_per_bin);
  const auto begin = std::chrono::steady_clock::now();
  locator->BuildLocator();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  const std::string name = "vtkStaticCellLocator, " + std::to_string(cells_per_bin) + " cells per bin";
  std::printf("%s: built in %.2f s\n", name.c_str(), time.count());

  vtkNew<vtkGenericCell> cell;
  std::array<double, 3> place{};
  std::array<double, 8> weights{};
  return locate_all(name, points, 5, [&](const Eigen::Vector3d& point, int) {
    std::array<double, 3> x{point[0], point[1], point[2]};
    return static_cast<int>(locator->FindCell(x.data(), 0, cell, place.data(), weights.data()));
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: vtk_location_benchmark MESH.h5 [BALLS]\n");
    return 1;
  }
  try {
    const MeshReader reader(argv[1]);
    const MeshGeometry geometry(reader.topology(), reader.read_points(0));
    const auto points = sampled_points(geometry, argc > 2 ? std::stoul(argv[2]) : 1000);
    const Located ours = locate_in_rotated_mesh(geometry, points);
    const auto grid = grid_of(geometry);
    print_comparison(geometry, ours, {locate_by_vtk(grid, points, 10), locate_by_vtk(grid, points, 1)});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vtk_location_benchmark: %s\n", error.what());
    return 1;
  }
  return 0;
}
