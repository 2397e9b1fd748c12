/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "resolutionAdvice.H"
#include "mathematicalConstants.H"
#include "readableLog.H"
#include "solidsFields.H"
#include "solidsSource.H"
#include "volFields.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Digits of the sizes
static constexpr label digits_ = 3;

//- Solidity of a dense charge, and the fewest balls in an average that the drag
//  laws were derived for
static constexpr scalar dense_ = 0.6;
static constexpr scalar fewBalls_ = 8;

//- Lengths across the mill's axis and along it, m
struct extent
{
    scalar across;
    scalar along;
};


//- Mean size of the cells by their volumes
static extent meanCell(const fvMesh& mesh)
{
    const scalarField& V = mesh.V();
    scalarField along(V.size());
    forAll(along, celli)
    {
        along[celli] =
            boundBox(mesh.points(), mesh.cellPoints(celli), false).span().z();
    }
    const scalar all = gSum(V);
    return {gSum((V * sqrt(V / along))()) / all, gSum((V * along)()) / all};
}


//- Sauter diameter of all balls, m
static scalar ballDiameter(const fvMesh& mesh, const solidsFields& sums)
{
    const scalarField& solidity = sums.solidity();
    scalar volume = 0;
    scalar overDiameter = 0;
    forAll(solidity, celli)
    {
        if (solidity[celli] > 0)
        {
            const scalar balls = solidity[celli] * mesh.V()[celli];
            volume += balls;
            overDiameter += balls / sums.diameter(celli);
        }
    }
    reduce(volume, sumOp<scalar>());
    reduce(overDiameter, sumOp<scalar>());
    return volume / max(overDiameter, VSMALL);
}


static scalar ballVolume(const scalar diameter)
{
    return constant::mathematical::pi / 6 * pow3(diameter);
}


//- Longer by more than what the form of a cell does
static bool longer(const scalar a, const scalar b)
{
    return a > 1.05 * b;
}


//- Keys of the voxels' size
static constexpr const char* voxelKeys_ =
    " (averages.voxel_size, averages.counts)";


//- The keys to change for cells that are larger than voxels. Whether there are
//  any
static bool
addLargeCells(Ostream& text, const extent& voxel, const extent& cell)
{
    const bool thick = longer(cell.along, voxel.along);
    const bool wide = longer(cell.across, voxel.across);
    if (thick)
    {
        text << " Layers that are thicker than the voxels pass over balls:"
             << " take layers of at most " << voxel.along
             << " m (resolution.layers, resolution.last_layer) or voxels of"
             << " at least " << cell.along << " m" << voxelKeys_ << ".";
    }
    if (wide)
    {
        text << " Cells that are wider than the voxels pass over balls: take"
             << " cells of at most " << voxel.across
             << " m (resolution.cell_size, resolution.counts) or voxels of at"
             << " least " << cell.across << " m" << voxelKeys_ << ".";
    }
    return thick || wide;
}


//- The keys to change for voxels, cells and balls of these sizes
static void
addKeys(Ostream& text, const extent& voxel, const extent& cell, const scalar d)
{
    const scalar balls =
        dense_ * sqr(voxel.across) * voxel.along / ballVolume(d);
    const scalar smallest = cbrt(fewBalls_ * ballVolume(d) / dense_);

    if (balls < fewBalls_)
    {
        text << " A voxel of a dense charge holds " << balls << " balls, and "
             << fewBalls_ << " make an average: take voxels of at least "
             << max(smallest, max(cell.across, cell.along)) << " m"
             << voxelKeys_ << ".";
        return;
    }
    if (addLargeCells(text, voxel, cell))
    {
        return;
    }
    text << " Walls and the charge's surface cut coarse voxels: take ";
    if (longer(voxel.across, 1.2 * smallest))
    {
        text << "smaller ones, down to " << smallest << " m" << voxelKeys_
             << ", with cells and layers no larger (resolution.cell_size,"
             << " resolution.layers).";
    }
    else
    {
        text << "others" << voxelKeys_ << ", or more balls in a longer mill;"
             << " these hold about as few balls as make an average.";
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::string Foam::resolutionAdvice(
    const fvMesh& mesh, const solidsSource& source, const solidsFields& sums)
{
    const vector spacing(source.spacing());
    const scalar d = ballDiameter(mesh, sums);
    if (!(spacing.z() > 0 && d > 0))
    {
        return string();
    }
    const extent voxel{sqrt(spacing.x() * spacing.y()), spacing.z()};
    const extent cell(meanCell(mesh));

    OStringStream text;
    text.precision(digits_);
    text << "There are " << label(std::lround(source.volume() / ballVolume(d)))
         << " balls of " << d << " m. The voxels are " << voxel.across
         << " m wide and " << voxel.along << " m long (z), the cells "
         << cell.across << " m and " << cell.along << " m in the mean.";
    addKeys(text, voxel, cell, d);
    return text.str() + " ";
}


// ************************************************************************* //
