/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellsOnVoxels.H"
#include "Pstream.H"
#include "untrapped.H"

#include <algorithm>

using namespace millfoam::averaging;

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Eigen::Isometry3d Foam::cellsOnVoxels::locate()
{
    if (cells_)
    {
        if (const std::optional<Eigen::Isometry3d> motion = motion_.place())
        {
            return *motion;
        }
    }
    cells_ = std::make_unique<CellPoints>(motion_.begin(), divisions_);
    return Eigen::Isometry3d::Identity();
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellsOnVoxels::cellsOnVoxels(const fvMesh& mesh, const label divisions)
: motion_(mesh),
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
