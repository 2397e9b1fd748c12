/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsMill.H"
#include "solidsGrid.H"

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
    if (!cells.motion.empty() &&
        mag(cells.time - solids.time0()) > solids.timestep())
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


// ************************************************************************* //
