/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellsOnVoxels.H"
#include "averagingMesh.H"
#include "fvMesh.H"
#include "Pstream.H"
#include "untrapped.H"

#include <algorithm>

using namespace millfoam::averaging;

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

std::optional<Eigen::Isometry3d> Foam::cellsOnVoxels::place() const
{
    static_assert(sizeof(point) == 3 * sizeof(double), "points are doubles");
    using Points = Eigen::Map<const Eigen::Matrix3Xd>;
    const pointField& now = mesh_.points();
    const Points from(made_.cdata()->cdata(), 3, made_.size());
    const Points to(now.cdata()->cdata(), 3, now.size());

    Eigen::Isometry3d motion;
    motion.matrix() = Eigen::umeyama(from, to, false);
    const scalar off =
        ((motion.linear() * from).colwise() + motion.translation() - to)
            .cwiseAbs()
            .maxCoeff();
    // Round-off of the points, relative to the size of the mesh
    const scalar size = to.cwiseAbs().maxCoeff();
    return off < 1e-10 * size ? std::optional(motion) : std::nullopt;
}


Eigen::Isometry3d Foam::cellsOnVoxels::locate()
{
    if (cells_)
    {
        if (const std::optional<Eigen::Isometry3d> motion = place())
        {
            return *motion;
        }
    }
    const MeshGeometry geometry(
        averagingTopology(
            mesh_.nPoints(), mesh_.nCells(), mesh_.faces(), mesh_.faceOwner(),
            mesh_.faceNeighbour()),
        averagingPoints(mesh_.points()));
    cells_ = std::make_unique<CellPoints>(geometry, divisions_);
    made_ = mesh_.points();
    return Eigen::Isometry3d::Identity();
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellsOnVoxels::cellsOnVoxels(const fvMesh& mesh, const label divisions)
: mesh_(mesh),
  divisions_(divisions)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

VoxelSums Foam::cellsOnVoxels::sum(
    const BoxGrid& grid, const std::vector<double>& values,
    const std::size_t components)
{
    VoxelSums sums(grid.size(), components);
    const auto reason = untrapped(
        [&]
        {
            const Eigen::Isometry3d motion(locate());
            cells_->deposit(grid, motion, values, sums);
        });
    if (reason)
    {
        FatalErrorInFunction << reason->c_str() << exit(FatalError);
    }
    return sums;
}


void Foam::sumOnMaster(std::vector<double>& values)
{
    scalarList sums(UList<scalar>(values.data(), label(values.size())));
    Pstream::listCombineGather(sums, plusEqOp<scalar>());
    std::copy(sums.begin(), sums.end(), values.begin());
}


// ************************************************************************* //
