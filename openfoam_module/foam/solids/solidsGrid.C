/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsGrid.H"

#include <variant>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using millfoam::averaging::CylinderGrid;
using millfoam::averaging::LocalSolids;
using millfoam::averaging::MeshCells;

//- Samples a window at a point of whatever grid a file has
struct pointSampler
{
    const millfoam::averaging::SolidsWindow& window;
    const point& p;
    millfoam::averaging::Interpolation interpolation;

    //- DEM time, s
    scalar time;

    template <class Grid> LocalSolids operator()(const Grid& grid) const
    {
        return millfoam::averaging::sample(
            grid, window, {p.x(), p.y(), p.z()}, interpolation);
    }

    //- A cylinder may turn
    LocalSolids operator()(const CylinderGrid& grid) const
    {
        return millfoam::averaging::sample(
            grid, window, {p.x(), p.y(), p.z()}, interpolation, time);
    }

    //- Fields on cells are not looked up by points
    LocalSolids operator()(const MeshCells&) const
    {
        return LocalSolids();
    }
};

//- Lengths of a grid's voxels, m; of a cylinder's at half of its radius
struct lengthsOf
{
    vector operator()(const millfoam::averaging::BoxGrid& grid) const
    {
        const auto lengths = grid.spacing();
        return vector(lengths[0], lengths[1], lengths[2]);
    }

    vector operator()(const CylinderGrid& grid) const
    {
        const auto lengths = grid.spacing();
        return vector(lengths[0], lengths[1] * grid.radii()[1] / 2, lengths[2]);
    }

    vector operator()(const MeshCells&) const
    {
        return vector::zero;
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

millfoam::averaging::LocalSolids Foam::solidsAt(
    const point& p, const millfoam::averaging::Grid& grid,
    const millfoam::averaging::SolidsWindow& window,
    const millfoam::averaging::Interpolation interpolation, const scalar time)
{
    return std::visit(pointSampler{window, p, interpolation, time}, grid);
}


Foam::vector Foam::voxelLengths(const millfoam::averaging::Grid& grid)
{
    return std::visit(lengthsOf(), grid);
}


std::optional<double> Foam::turning(const millfoam::averaging::Grid& grid)
{
    const auto* cylinder = std::get_if<CylinderGrid>(&grid);
    return cylinder ? cylinder->frame().angular_velocity : std::nullopt;
}


// ************************************************************************* //
