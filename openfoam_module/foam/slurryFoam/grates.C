/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "grates.H"
#include "knownEntries.H"
#include "openfoam_module/drag/pore_shear_rate.hpp"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::grates::layer Foam::grates::readLayer(const dictionary& dict) const
{
    requireKnownEntries(
        dict, {"cellZone", "darcy", "forchheimer", "viscosity"});
    const word zone(dict.get<word>("cellZone"));
    layer result{
        mesh_.cellZones().findZoneID(zone),
        dict.lookupOrDefault<scalar>("darcy", 0),
        dict.lookupOrDefault<scalar>("forchheimer", 0),
        slurryViscosity(dict, fluids_.slurry)};
    if (result.zone < 0)
    {
        FatalIOErrorInFunction(dict)
            << "no cellZone " << zone << "; expected one of the mesh's "
            << flatOutput(mesh_.cellZones().names())
            << " (topoSet makes them before the flow begins)"
            << exit(FatalIOError);
    }
    if (!dict.found("darcy") && !dict.found("forchheimer"))
    {
        FatalIOErrorInFunction(dict)
            << "neither darcy nor forchheimer is given; expected one of them"
            << exit(FatalIOError);
    }
    if (!(result.darcy >= 0 && result.forchheimer >= 0))
    {
        FatalIOErrorInFunction(dict)
            << "darcy is " << result.darcy << " 1/m2 and forchheimer "
            << result.forchheimer << " 1/m; expected both 0 or above"
            << exit(FatalIOError);
    }
    return result;
}


Foam::vector Foam::grates::cellVelocity(const label celli) const
{
    if (!mesh_.moving())
    {
        return vector::zero;
    }
    const labelList& points = mesh_.cellPoints()[celli];
    vector moved(Zero);
    for (const label pointi : points)
    {
        moved += mesh_.points()[pointi] - mesh_.oldPoints()[pointi];
    }
    return moved / (points.size() * mesh_.time().deltaTValue());
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::grates::grates(
    const dictionary& dict, const fvMesh& mesh, const bedFluids& fluids)
: mesh_(mesh),
  fluids_(fluids),
  layers_()
{
    for (const char* ofLayer :
         {"cellZone", "darcy", "forchheimer", "viscosity"})
    {
        if (dict.found(ofLayer, keyType::LITERAL))
        {
            FatalIOErrorInFunction(dict)
                << ofLayer
                << " is outside of a grate; expected it within a grate's"
                << " braces, name { cellZone ...; }" << exit(FatalIOError);
        }
    }
    for (const entry& one : dict)
    {
        // The dictionary may also have numbers that other entries refer to
        if (one.isDict())
        {
            layers_.push_back(readLayer(one.dict()));
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::grates::add(
    volScalarField& coefficient, volVectorField& velocity,
    const volScalarField& alpha, const volVectorField& U) const
{
    for (const layer& one : layers_)
    {
        const auto resistance =
            [&one](const millfoam::drag::Fluid& fluid, const scalar speed)
        {
            return fluid.viscosity * one.darcy +
                   fluid.density * one.forchheimer * speed / 2;
        };
        const auto slurryAt = [&](const scalar speed) -> millfoam::drag::Fluid
        {
            return {
                fluids_.slurryDensity,
                one.viscosity.at(
                    millfoam::drag::tube_shear_rate(one.darcy, speed))};
        };
        for (const label celli : mesh_.cellZones()[one.zone])
        {
            const vector w(cellVelocity(celli));
            const scalar speed = mag(U[celli] - w);
            const scalar added =
                alpha[celli] * resistance(slurryAt(speed), speed) +
                (1 - alpha[celli]) * resistance(fluids_.air, speed);
            const scalar all = coefficient[celli] + added;
            if (all > 0)
            {
                velocity[celli] += added / all * (w - velocity[celli]);
                coefficient[celli] = all;
            }
        }
    }
    coefficient.correctBoundaryConditions();
    velocity.correctBoundaryConditions();
}


// ************************************************************************* //
