/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Application
    openfoam_location_benchmark

Description
    Locates the same points by OpenFOAM's meshSearch and by averaging's
    CellLocator in the mesh of a case.

Usage
    \b openfoam_location_benchmark -case DIR [-balls N]

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "averagingMesh.H"
#include "meshSearch.H"
#include "polyMesh.H"
#include "Time.H"
#include "untrapped.H"
#include "tests/benchmarks/location_comparison.hpp"

using namespace Foam;
using namespace millfoam::averaging;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

static Located search(
    const string& name, const meshSearch& engine, const bool seeded,
    const std::vector<Eigen::Vector3d>& points)
{
    // Builds the tree
    engine.findCell(point(points[0][0], points[0][1], points[0][2]));
    return locate_all(
        name, points, 3,
        [&](const Eigen::Vector3d& p, const int last) {
            return engine.findCell(point(p[0], p[1], p[2]), seeded ? last : -1);
        });
}


int main(int argc, char* argv[])
{
    argList::noParallel();
    argList::noBanner();
    argList::addOption("balls", "n", "Number of balls sampled");
    argList args(argc, argv);
    Time time(Time::controlDictName, args, "system", "constant");
    const polyMesh mesh(
        IOobject(polyMesh::defaultRegion, time.constant(), time));

    const auto failure = untrapped(
        [&]()
        {
            const MeshGeometry geometry(
                averagingTopology(
                    mesh.nPoints(), mesh.nCells(), mesh.faces(),
                    mesh.faceOwner(), mesh.faceNeighbour()),
                averagingPoints(mesh.points()));
            const auto points = sampled_points(
                geometry, args.lookupOrDefault<label>("balls", 1000));

            const meshSearch tets(mesh, polyMesh::CELL_TETS);
            const meshSearch planes(mesh, polyMesh::FACE_PLANES);
            const Located ours = locate_in_rotated_mesh(geometry, points);
            print_comparison(
                geometry, ours,
                {search("meshSearch, octree (tetrahedra)", tets, false, points),
                 search(
                     "meshSearch, walk from the last cell", tets, true, points),
                 search(
                     "meshSearch, octree, face planes", planes, false, points),
                 search(
                     "meshSearch, walk, face planes", planes, true, points)});
        });
    if (failure)
    {
        FatalErrorInFunction << *failure << exit(FatalError);
    }
    return 0;
}

// ************************************************************************* //
