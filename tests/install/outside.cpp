// Uses an installed millFoam as a user's own program does.
#include <cstdio>

#include "averaging/overlap/sphere_box.hpp"
#include "meshing/mill/mill_reader.hpp"
#include "millfoam_version.hpp"
#include "openfoam_module/drag/drag_laws.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const double volume = millfoam::averaging::sphere_box_volume({0, 0, 0}, {1, 1, 1}, 1.0);
  const double radius = millfoam::meshing::read_mill(argv[1]).geometry.radius();
  std::printf("%s %.15g %.15g %.15g\n", millfoam::version(), volume, millfoam::drag::ergun(0.5, 10), radius);
}
