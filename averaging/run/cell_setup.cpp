// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/cell_setup.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "averaging/deposition/cylindrical_deposition.hpp"
#include "averaging/deposition/exact_box_deposition.hpp"
#include "averaging/deposition/exact_cylinder_deposition.hpp"
#include "averaging/deposition/exact_mesh_deposition.hpp"
#include "averaging/deposition/sampled_box_deposition.hpp"
#include "averaging/deposition/sampled_cylinder_deposition.hpp"
#include "averaging/deposition/sampled_mesh_deposition.hpp"
#include "averaging/grids/neighbours.hpp"
#include "averaging/mesh/deforming_mesh.hpp"
#include "averaging/mesh/mesh_cells.hpp"
#include "averaging/mesh/mesh_file.hpp"
#include "averaging/mesh/moving_mesh.hpp"
#include "averaging/mesh/periodic_faces.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/surface/mill_size.hpp"

namespace millfoam::averaging {

namespace {

using Note = std::function<void(const std::string&)>;

std::string method_in_words(const AverageRequest& request) {
  const std::string points = std::to_string(request.template_points) + " points along a diameter";
  const bool exact = request.method == DepositionMethod::exact;
  const std::string method = exact ? "exact" : "sample, " + points;
  if (request.superquadrics_as_spheres) return method + "; superquadrics as spheres of equal volume";
  return exact ? method + "; superquadrics: " + points : method;
}

std::string rotation(double angular_velocity) {
  std::ostringstream text;
  text.precision(17);
  text << "rotation speed " << angular_velocity;
  return text.str();
}

/// One of two classes for the same cells, by the requested method.
template <typename Exact, typename Sampling, typename... Arguments>
std::unique_ptr<Deposition> by_method(DepositionMethod method, Arguments&&... arguments) {
  if (method == DepositionMethod::exact)
    return std::make_unique<Exact>(std::forward<Arguments>(arguments)...);
  return std::make_unique<Sampling>(std::forward<Arguments>(arguments)...);
}

/// Does something with a mesh. What it throws, std::invalid_argument, names the mesh and what was asked of
/// it.
/// @param option  or options that give the mesh, with their values
/// @param action  without arguments
template <typename Action>
auto naming_mesh(const std::string& option, Action&& action) {
  try {
    return action();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(option + ": " + error.what());
  }
}

std::vector<double> voxel_volumes(const Grid& grid) {
  std::vector<double> volumes(cell_count(grid));
  for (std::size_t c = 0; c < volumes.size(); ++c) volumes[c] = cell_volume(grid, c);
  return volumes;
}

/// A surface at a time, s, turned to where it is in the frame that turns with it.
void turn_back(const Motion& motion, double time, Surface& surface) {
  const Eigen::Isometry3d back = motion.place(time).inverse();
  for (Eigen::Vector3d& point : surface.points) point = back * point;
}

/// Throws for walls that cannot be of a mill in m.
void require_metres(const Eigen::AlignedBox3d& walls) {
  const double largest = walls.sizes().maxCoeff();
  if (largest <= surface::largest_mill) return;
  throw std::invalid_argument(
      "--inside: the walls are " + shown(largest) + " m long, above " + shown(surface::largest_mill) +
      " m; expected walls in m (millMesh surface --scale 0.001 converts millimetres)");
}

double width_of(const BoxGrid& grid) {
  return std::max(grid.upper()[0] - grid.lower()[0], grid.upper()[1] - grid.lower()[1]);
}

double width_of(const CylinderGrid& grid) {
  return 2 * grid.radii()[1];
}

/// Walls that move, and their width across z over the grid's.
struct Walls {
  std::shared_ptr<const MovingWalls> moving;
  double over_grid = 0;
};

/// The walls that cut the voxels, turning with the mill; at rest in a grid that turns with it.
Walls moving_walls(const std::variant<BoxGrid, CylinderGrid>& grid, const AverageRequest& request,
                   const RunSettings& settings, const Note& note) {
  Surface surface;
  double time = 0;
  if (request.walls.size() == 1 && request.walls[0].extension() == ".h5") {
    const MeshReader mesh(request.walls[0]);
    if (mesh.times().size() > 1) {
      throw std::invalid_argument("--inside " + request.walls[0].string() +
                                  " gives points at several times, expected walls that keep their shape");
    }
    surface = naming_mesh("--inside " + request.walls[0].string(), [&] {
      return boundary_surface(MeshGeometry(mesh.topology(), mesh.read_points(0)));
    });
    time = mesh.time0() + mesh.times().front();
  } else {
    for (const std::filesystem::path& file : request.walls) {
      if (file.extension() != ".h5") continue;
      throw std::invalid_argument("--inside: the mesh file " + file.string() +
                                  " is one of several files, expected it alone, or STL files");
    }
    surface = read_surface(request.walls);
    if (surface.caps > 0) note("the walls are open at an end across z; a plane closes them there");
  }
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3d& point : surface.points) extent.extend(point);
  require_metres(extent);
  std::shared_ptr<const Motion> motion;
  const auto* cylinder = std::get_if<CylinderGrid>(&grid);
  if (cylinder != nullptr && cylinder->frame().angular_velocity) {
    turn_back(*parse_motion({rotation(*cylinder->frame().angular_velocity)}), time, surface);
  } else if (settings.angular_velocity.value_or(0) != 0) {
    motion = parse_motion({rotation(*settings.angular_velocity)});
  } else if (!settings.angular_velocity) {
    note("the walls are taken to be at rest: neither --speed nor run.json gives the mill's angular velocity");
  }
  const double width = std::visit([](const auto& voxels) { return width_of(voxels); }, grid);
  return {std::make_shared<MovingWalls>(grid, surface, motion, time),
          extent.sizes().head<2>().maxCoeff() / width};
}

/// A cell's name and the place of its middle.
std::string place_in_words(const std::string& name, const Vector3& centre) {
  std::ostringstream text;
  text.precision(4);
  text << name << " at x " << centre[0] << ", y " << centre[1] << ", z " << centre[2] << " m";
  return text.str();
}

/// What boxes and cylinders have in common.
template <typename Exact, typename Sampling, typename Voxels>
CellSetup set_up_voxels(const Voxels& grid, const AverageRequest& request, const RunSettings& settings,
                        const Note& note) {
  std::unique_ptr<Deposition> deposition =
      by_method<Exact, Sampling>(request.method, grid, request.template_points);
  CellSetup setup{grid, std::move(deposition), {}, nullptr, nullptr, method_in_words(request), 0, {}};
  setup.limits.solidity_cap = request.solidity_cap;
  setup.limits.place = [grid](std::size_t cell) {
    return place_in_words(cell_name(grid, cell), *voxel_centre(grid, cell));
  };
  if (!request.walls.empty()) {
    const Walls walls = moving_walls(grid, request, settings, note);
    setup.walls = walls.moving;
    setup.walls_over_grid = walls.over_grid;
    setup.limits.whole_volumes = voxel_volumes(setup.grid);
  }
  if (request.solidity_cap || setup.walls) setup.limits.neighbours = neighbours(grid);
  return setup;
}

CellSetup set_up_cells(const BoxGrid& grid, const AverageRequest& request, const RunSettings& settings,
                       const Note& note) {
  return set_up_voxels<ExactBoxDeposition, SampledBoxDeposition>(grid, request, settings, note);
}

CylinderFrame frame_of(const CylinderRequest& cylinder, const RunSettings& settings) {
  CylinderFrame frame{cylinder.cylindrical || cylinder.turning, std::nullopt};
  if (!cylinder.turning) return frame;
  if (!settings.angular_velocity) {
    throw std::invalid_argument(
        "--frame is turning, but neither --speed nor run.json gives the mill's angular velocity; expected "
        "one "
        "of them");
  }
  frame.angular_velocity = settings.angular_velocity;
  return frame;
}

CellSetup set_up_cells(const CylinderRequest& cylinder, const AverageRequest& request,
                       const RunSettings& settings, const Note& note) {
  const CylinderGrid& at_rest = cylinder.grid;
  const CylinderFrame frame = frame_of(cylinder, settings);
  const CylinderGrid grid(at_rest.radii(), at_rest.ends(), at_rest.shape(), at_rest.periodic_z(), frame);
  CellSetup setup =
      set_up_voxels<ExactCylinderDeposition, SampledCylinderDeposition>(grid, request, settings, note);
  if (frame.cylindrical) {
    setup.deposition = std::make_unique<CylindricalDeposition>(std::move(setup.deposition),
                                                               frame.angular_velocity.value_or(0));
  }
  return setup;
}

/// How a mesh that keeps its shape moves, in the words of `parse_motion`; empty at rest.
std::vector<std::string> motion_of(const MeshRequest& mesh, const RunSettings& settings, const Note& note) {
  if (mesh.at_rest) return {};
  if (!mesh.motion.empty()) return mesh.motion;
  if (!settings.angular_velocity) {
    note("the mesh is taken to be at rest: neither --motion, --speed nor run.json gives its motion");
    return {};
  }
  note("the mesh turns with the mill: " + rotation(*settings.angular_velocity) + " rad/s");
  return {rotation(*settings.angular_velocity)};
}

std::string joined(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) result += (result.empty() ? "" : "; ") + text;
  return result.empty() ? "at rest" : result;
}

std::vector<std::array<int, 2>> neighbours(const MeshGeometry& mesh, std::optional<double> period) {
  std::vector<std::array<int, 2>> pairs = averaging::neighbours(mesh.topology());
  if (!period) return pairs;
  for (const auto& [low, high] : periodic_faces(mesh, *period)) {
    const int a = mesh.topology().owner[static_cast<std::size_t>(low)];
    const int b = mesh.topology().owner[static_cast<std::size_t>(high)];
    if (a != b) pairs.push_back({a, b});
  }
  return pairs;
}

void require_fitting(const MeshRequest& mesh, const AverageRequest& request, bool deforms) {
  if (!request.walls.empty()) {
    throw std::invalid_argument(
        "--inside is for voxels that walls cut; the cells of a mesh lie inside already");
  }
  if (!deforms) return;
  if (!mesh.motion.empty() || mesh.at_rest) {
    throw std::invalid_argument("--motion is given, but " + mesh.file.string() +
                                " gives points at several times, which are its motion; expected one of them");
  }
  if (mesh.smoothed) {
    throw std::invalid_argument("--smooth needs a mesh that keeps its shape, and " + mesh.file.string() +
                                " gives points at several times");
  }
}

CellSetup set_up_cells(const MeshRequest& request, const AverageRequest& whole, const RunSettings& settings,
                       const Note& note) {
  const MeshReader file(request.file);
  const bool deforms = file.times().size() > 1;
  require_fitting(request, whole, deforms);

  std::unique_ptr<MovingMesh> mesh;
  MeshCells cells;
  const double time = file.time0() + file.times().front();
  const std::string name = "--mesh " + request.file.string();
  const std::string with_period = request.period_z ? name + " --period " + shown(*request.period_z) : name;
  if (deforms) {
    mesh = naming_mesh(
        name, [&] { return std::make_unique<DeformingMesh>(std::make_shared<MeshSeries>(request.file)); });
    mesh->begin_record(time);
    cells = mesh_cells(mesh->geometry());
    cells.motion = "points over time";
  } else {
    const std::vector<std::string> motion = motion_of(request, settings, note);
    const std::shared_ptr<const Motion> turning = parse_motion(motion);
    PreparedMesh prepared = naming_mesh(name, [&] { return prepare(file.topology(), file.read_points(0)); });
    mesh = std::make_unique<RigidMesh>(std::move(prepared), turning, time);
    cells = mesh_cells(mesh->geometry());
    cells.motion = joined(motion);
  }
  cells.file = request.file.filename().string();
  cells.time = time;

  CellSetup setup{std::move(cells), nullptr, {}, nullptr, nullptr, method_in_words(whole), 0, {}};
  setup.limits.solidity_cap = whole.solidity_cap;
  if (whole.solidity_cap) {
    setup.limits.neighbours =
        naming_mesh(with_period, [&] { return neighbours(mesh->geometry(), request.period_z); });
    setup.limits.place = [centres = mesh->geometry().centres()](std::size_t cell) {
      const Eigen::Vector3d& c = centres[cell];
      return place_in_words("cell " + std::to_string(cell), {c.x(), c.y(), c.z()});
    };
  }
  if (request.smoothed) {
    setup.smoothing = request.smoothing > 0 ? request.smoothing : usual_smoothing * settings.sauter_diameter;
    setup.diffusion = naming_mesh(with_period, [&] {
      return std::make_shared<MeshDiffusion>(mesh->geometry(), setup.smoothing, request.period_z);
    });
    note("smoothing over a width of " + shown(setup.smoothing) + " m");
  }
  setup.deposition = naming_mesh(with_period, [&] {
    return by_method<ExactMeshDeposition, SampledMeshDeposition>(whole.method, std::move(mesh),
                                                                 whole.template_points, request.period_z);
  });
  return setup;
}

}  // namespace

CellSetup set_up(const AverageRequest& request, const RunSettings& settings, const Note& note) {
  return std::visit([&](const auto& grid) { return set_up_cells(grid, request, settings, note); },
                    request.grid);
}

}  // namespace millfoam::averaging
