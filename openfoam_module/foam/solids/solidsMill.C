/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsMill.H"
#include "fvMesh.H"
#include "mathematicalConstants.H"
#include "meshRotation.H"
#include "solidsGrid.H"
#include "uniformDimensionedFields.H"

#include <cmath>
#include <variant>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

using millfoam::averaging::MeshCells;

//- Whether cells move in the words of their file
bool moves(const MeshCells& cells)
{
    return !cells.motion.empty() && cells.motion != "at rest";
}


//- Whether the flow's gravity has a part across z; false where it is not known
bool lies(const fvMesh& mesh)
{
    const auto* g = mesh.findObject<uniformDimensionedVectorField>("g", true);
    if (!g)
    {
        return false;
    }
    const vector across(g->value().x(), g->value().y(), 0);
    return mag(across) > 1e-3 * mag(g->value());
}


//- What the windows move with, in words, and at which speed, rad/s; none where
//  it is a function of time
struct carrier
{
    string words;
    std::optional<scalar> omega;
};


//- Speed of a mesh that moves, rad/s, 0 of one that does not turn; none where it
//  is a function of time
std::optional<scalar> speedOf(const fvMesh& mesh)
{
    return meshTurns(mesh.time()) ? constantMeshRotation(mesh.time()) : 0;
}


//- What the solids move with; none where they keep their place, or where a
//  charge may turn
std::optional<carrier>
carrierOf(const millfoam::averaging::Grid& grid, const fvMesh& mesh)
{
    if (const auto* cells = std::get_if<MeshCells>(&grid))
    {
        return moves(*cells) ? std::optional<carrier>(
                                   {"the cells of a mesh that moves (" +
                                        cells->motion + ")",
                                    speedOf(mesh)})
                             : std::nullopt;
    }
    const std::optional<double> omega = turning(grid);
    return omega && *omega != 0 && lies(mesh)
               ? std::optional<carrier>({"a cylinder that turns", *omega})
               : std::nullopt;
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::requireMill(
    const dictionary& dict, const fileName& file,
    const millfoam::averaging::SolidsReader& solids)
{
    const millfoam::averaging::SolidsHeader& header = solids.header();

    const std::optional<double> known = turning(solids.grid())
                                            ? turning(solids.grid())
                                            : header.angular_velocity;
    scalar omega = 0;
    if (dict.readIfPresent("omega", omega) && known)
    {
        const scalar recorded = *known;
        if (mag(omega - recorded) > 1e-6 * max(mag(omega), mag(recorded)))
        {
            FatalIOErrorInFunction(dict)
                << "omega is " << omega << " rad/s but the mill of " << file
                << " turned with " << recorded << " rad/s; expected the solids"
                << " of this speed. Run millDem and millAverage again, or make"
                << " the flow's mesh with the speed of the solids"
                << exit(FatalIOError);
        }
    }

    string fingerprint;
    if (dict.readIfPresent("fingerprint", fingerprint) &&
        !fingerprint.empty() && !header.mill_averages.empty() &&
        fingerprint != header.mill_averages)
    {
        FatalIOErrorInFunction(dict)
            << "fingerprint is " << fingerprint.c_str() << " but " << file
            << " was averaged for the mill with the fingerprint "
            << header.mill_averages.c_str() << "; expected the solids of this"
            << " mill. Run millAverage again, and before it millDem if its"
            << " dumps are of another mill too" << exit(FatalIOError);
    }
}


void Foam::adviseMeshTime(
    const fileName& file, const millfoam::averaging::SolidsReader& solids,
    const millfoam::averaging::MeshCells& cells)
{
    if (moves(cells) && mag(cells.time - solids.time0()) > solids.timestep())
    {
        WarningInFunction
            << file << ": the mesh " << cells.file.c_str()
            << " holds for DEM time " << scalar(cells.time)
            << " s but the solids begin at " << solids.time0()
            << " s, which is flow time 0: the flow's mesh is not where the"
            << " solids' was. Make the mesh with millMesh --at-time "
            << solids.time0() << " or average from --start "
            << scalar(cells.time) << endl;
    }
}


void Foam::requireChargeInPlace(
    const dictionary& dict, const fileName& file,
    const millfoam::averaging::SolidsReader& solids, const solidsClock& clock,
    const fvMesh& mesh)
{
    const std::optional<carrier> with = carrierOf(solids.grid(), mesh);
    if (!with || clock.outOfRange() == solidsClock::range::error)
    {
        return;
    }

    if (solids.whole_run())
    {
        FatalIOErrorInFunction(dict)
            << file << " holds one mean over the whole run on "
            << with->words.c_str() << ": the charge would turn round the mill;"
            << " expected windows (millAverage --window) and outOfRange error,"
            << " or solids on a box" << exit(FatalIOError);
    }
    if (clock.outOfRange() == solidsClock::range::hold)
    {
        FatalIOErrorInFunction(dict)
            << "outOfRange is hold but " << file << " holds solids on "
            << with->words.c_str() << ": beyond the recorded time the charge"
            << " would turn round the mill; expected error, or solids on a box"
            << exit(FatalIOError);
    }

    if (!with->omega)
    {
        FatalIOErrorInFunction(dict)
            << "outOfRange is repeat but " << file << " holds solids on "
            << with->words.c_str() << " with an omega that is a function of"
            << " time: the charge would jump at each repetition; expected a"
            << " number for omega of constant/dynamicMeshDict, or outOfRange"
            << " error, or solids on a box" << exit(FatalIOError);
    }
    const scalar omega = *with->omega;
    const scalar turns =
        mag(omega) * clock.duration() / constant::mathematical::twoPi;
    const scalar whole = omega != 0 ? max(1.0, std::round(turns)) : 0;
    if (mag(turns - whole) > 1e-3)
    {
        FatalIOErrorInFunction(dict)
            << "outOfRange is repeat but " << file << " holds solids on "
            << with->words.c_str() << ", and its " << clock.duration()
            << " s are " << turns << " turns of " << omega
            << " rad/s: the charge would jump at each repetition; expected a"
            << " whole number of turns (to 0.001), or error, or solids on a box"
            << exit(FatalIOError);
    }
}


// ************************************************************************* //
