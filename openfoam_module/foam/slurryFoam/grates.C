/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "grates.H"
#include "cyclicPolyPatch.H"
#include "knownEntries.H"
#include "processorCyclicPolyPatch.H"
#include "upwind.H"
#include "zeroFields.H"
#include "openfoam_module/drag/pore_shear_rate.hpp"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Refuse a zone or patch without cells or faces on all ranks
static void requireAny(
    const label members, const char* what, const word& name,
    const dictionary& dict)
{
    if (returnReduce(members, sumOp<label>()) == 0)
    {
        FatalIOErrorInFunction(dict)
            << name << " has no " << what << "; expected some. Check the box of"
            << " topoSet, in m" << exit(FatalIOError);
    }
}


//- Refuse the faces of a cyclic patch, also where it is divided over ranks
static void refuseCyclic(const polyPatch& patch, const dictionary& dict)
{
    const auto* divided = isA<processorCyclicPolyPatch>(patch);
    if (isA<cyclicPolyPatch>(patch) || divided)
    {
        FatalIOErrorInFunction(dict)
            << "faces are on "
            << (divided ? divided->referPatchName() : patch.name())
            << ", which is cyclic; expected inner faces or an open patch"
            << exit(FatalIOError);
    }
}

} // End namespace Foam


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
    requireAny(mesh_.cellZones()[result.zone].size(), "cells", zone, dict);
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


Foam::labelList
Foam::grates::facesNamed(const word& name, const dictionary& dict) const
{
    const label zone = mesh_.faceZones().findZoneID(name);
    if (zone >= 0)
    {
        requireAny(mesh_.faceZones()[zone].size(), "faces", name, dict);
        return mesh_.faceZones()[zone];
    }
    const label patchi = mesh_.boundaryMesh().findPatchID(name);
    if (patchi < 0)
    {
        FatalIOErrorInFunction(dict)
            << "no faceZone or patch " << name
            << "; expected one of the mesh's "
            << flatOutput(mesh_.faceZones().names()) << ' '
            << flatOutput(mesh_.boundaryMesh().names())
            << " (topoSet makes zones before the flow begins)"
            << exit(FatalIOError);
    }
    const polyPatch& patch = mesh_.boundaryMesh()[patchi];
    refuseCyclic(patch, dict);
    requireAny(patch.size(), "faces", name, dict);
    return identity(patch.size(), patch.start());
}


Foam::grates::plate Foam::grates::readPlate(const dictionary& dict) const
{
    requireKnownEntries(dict, {"faces", "loss"});
    plate result{
        facesNamed(dict.get<word>("faces"), dict), dict.get<scalar>("loss")};
    if (!(result.loss >= 0))
    {
        FatalIOErrorInFunction(dict)
            << "loss is " << result.loss << "; expected 0 or above"
            << exit(FatalIOError);
    }
    for (const label facei : result.faces)
    {
        const label patchi = mesh_.boundaryMesh().whichPatch(facei);
        if (patchi >= 0)
        {
            refuseCyclic(mesh_.boundaryMesh()[patchi], dict);
        }
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
  layers_(),
  plates_()
{
    for (const char* ofGrate :
         {"cellZone", "darcy", "forchheimer", "viscosity", "faces", "loss"})
    {
        if (dict.found(ofGrate, keyType::LITERAL))
        {
            FatalIOErrorInFunction(dict)
                << ofGrate
                << " is outside of a grate; expected it within a grate's"
                << " braces, name { faces ...; } or name { cellZone ...; }"
                << exit(FatalIOError);
        }
    }
    for (const entry& one : dict)
    {
        // The dictionary may also have numbers that other entries refer to
        if (!one.isDict())
        {
            continue;
        }
        if (one.dict().found("faces") || one.dict().found("loss"))
        {
            plates_.push_back(readPlate(one.dict()));
        }
        else
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


Foam::tmp<Foam::surfaceScalarField> Foam::grates::resistance(
    const surfaceScalarField& flux, const volScalarField& alpha) const
{
    tmp<surfaceScalarField> tresistance(
        zeroFaces(mesh_, "plateResistance", dimDensity / dimTime));
    surfaceScalarField& resistance = tresistance.ref();
    const surfaceScalarField slurry(
        upwind<scalar>(mesh_, flux).interpolate(alpha));
    const surfaceScalarField& area = mesh_.magSf();
    const surfaceScalarField& inverseLength = mesh_.nonOrthDeltaCoeffs();
    const auto at = [&](const scalar q, const scalar share, const scalar loss,
                        const scalar size, const scalar perLength)
    {
        const scalar density =
            share * fluids_.slurryDensity + (1 - share) * fluids_.air.density;
        return 0.5 * loss * density * mag(q) / size * perLength;
    };
    for (const plate& one : plates_)
    {
        for (const label facei : one.faces)
        {
            if (mesh_.isInternalFace(facei))
            {
                resistance[facei] +=
                    at(flux[facei], slurry[facei], one.loss, area[facei],
                       inverseLength[facei]);
                continue;
            }
            const label patchi = mesh_.boundaryMesh().whichPatch(facei);
            const label i = facei - mesh_.boundaryMesh()[patchi].start();
            if (!flux.boundaryField()[patchi].empty())
            {
                resistance.boundaryFieldRef()[patchi][i] +=
                    at(flux.boundaryField()[patchi][i],
                       slurry.boundaryField()[patchi][i], one.loss,
                       area.boundaryField()[patchi][i],
                       inverseLength.boundaryField()[patchi][i]);
            }
        }
    }
    return tresistance;
}


// ************************************************************************* //
