/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "sharpPressure.H"
#include "fixedFluxPressureFvPatchScalarField.H"
#include "surfaceInterpolate.H"
#include "zeroFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Boundary values of p_rgh as they follow from its cells; walls keep the
//  slope of the latest projection
void refreshBoundary(volScalarField& p_rgh)
{
    for (fvPatchScalarField& patch : p_rgh.boundaryFieldRef())
    {
        if (isA<fixedFluxPressureFvPatchScalarField>(patch))
        {
            auto& wall = refCast<fixedFluxPressureFvPatchScalarField>(patch);
            wall.updateSnGrad(scalarField(wall.gradient()));
        }
    }
    p_rgh.correctBoundaryConditions();
}


//- Share of the pressure's rise across a face on a cell's side of it; part: of
//  the line on that side. One acceleration on both sides: slopes go with the
//  densities, but neither share is above 1 where the line is mostly air
scalar
shareOfRise(const scalar part, const scalar density, const scalar lineDensity)
{
    return min(part * density / lineDensity, scalar(1));
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::sharpPressure::boundaryJumps(const volScalarField& mixtureDensity)
{
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatchScalarField& p = p_rgh_.boundaryField()[patchi];
        if (p.coupled() || !p.fixesValue())
        {
            continue;
        }
        jump_.boundaryFieldRef()[patchi] =
            (mixtureDensity.boundaryField()[patchi] -
             density_.boundaryField()[patchi].patchInternalField()) *
            (g_.value() & mesh_.Cf().boundaryField()[patchi]);
    }
}


void Foam::sharpPressure::divide(
    scalarField& faceDensity, scalarField& massWeights,
    scalarField& lineWeights, const scalarField& side, const scalarField& line,
    const scalarField& ownHeld, const scalarField& neiHeld) const
{
    forAll(faceDensity, i)
    {
        const scalar w = lineWeights[i];
        const bool ownWet = side[i] > 0;
        const scalar slurry = line[i] * slurryDensity_.value();
        const scalar air = (1 - line[i]) * airDensity_.value();
        scalar own = w * (slurry + air + ownHeld[i]);
        scalar nei = (1 - w) * (slurry + air + neiHeld[i]);
        if (mag(side[i]) > 0.5)
        {
            // The slurry of the line is on the wet side, the air on the other
            own = ownWet ? slurry : air + w * ownHeld[i];
            nei = ownWet ? air + (1 - w) * neiHeld[i] : slurry;
            lineWeights[i] = ownWet ? line[i] : 1 - line[i];
        }
        faceDensity[i] = own + nei;
        massWeights[i] = own / faceDensity[i];
    }
}


void Foam::sharpPressure::setDensities(const volScalarField& mixtureDensity)
{
    const dimensionedScalar excess(slurryDensity_ - airDensity_);
    const surfaceScalarField line(surface_.wetLine());
    const surfaceScalarField side(surface_.side());
    density_ = airDensity_ + surface_.wet() * excess;
    lineDensity_ = airDensity_ + line * excess;

    const volScalarField held(
        (1 - surface_.wet()) * (mixtureDensity - airDensity_));
    inertia_ = density_ + held;

    lineWeights_ = mesh_.weights();
    divide(
        faceDensity_.primitiveFieldRef(), massWeights_.primitiveFieldRef(),
        lineWeights_.primitiveFieldRef(), side, line,
        scalarField(held.primitiveField(), mesh_.owner()),
        scalarField(held.primitiveField(), mesh_.neighbour()));
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatchScalarField& patch = held.boundaryField()[patchi];
        const bool coupled = patch.coupled();
        divide(
            faceDensity_.boundaryFieldRef()[patchi],
            massWeights_.boundaryFieldRef()[patchi],
            lineWeights_.boundaryFieldRef()[patchi],
            side.boundaryField()[patchi], line.boundaryField()[patchi],
            coupled ? patch.patchInternalField() : tmp<scalarField>(patch),
            coupled ? patch.patchNeighbourField() : tmp<scalarField>(patch));
    }
}


void Foam::sharpPressure::addInnerFaces(vectorField& sums) const
{
    const surfaceVectorField& Sf = mesh_.Sf();
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const label own = owner[facei];
        const label nei = neighbour[facei];
        const scalar w = mesh_.weights()[facei];
        const scalar rise = p_rgh_[nei] + jump_[facei] - p_rgh_[own];
        const scalar line = lineDensity_[facei];
        const scalar ownOnFace =
            p_rgh_[own] + shareOfRise(1 - w, density_[own], line) * rise;
        const scalar neiOnFace =
            p_rgh_[nei] - shareOfRise(w, density_[nei], line) * rise;
        sums[own] += Sf[facei] * ownOnFace;
        sums[nei] -= Sf[facei] * neiOnFace;
    }
}


void Foam::sharpPressure::addPatch(const label patchi, vectorField& sums) const
{
    const fvPatchScalarField& p = p_rgh_.boundaryField()[patchi];
    const fvPatch& patch = mesh_.boundary()[patchi];
    const scalarField& jump = jump_.boundaryField()[patchi];
    scalarField onFace(p + jump);
    if (p.coupled())
    {
        const scalarField own(p.patchInternalField());
        const scalarField rise(p.patchNeighbourField() + jump - own);
        const scalarField density(
            density_.boundaryField()[patchi].patchInternalField());
        forAll(onFace, i)
        {
            onFace[i] =
                own[i] + shareOfRise(
                             1 - mesh_.weights().boundaryField()[patchi][i],
                             density[i],
                             lineDensity_.boundaryField()[patchi][i]) *
                             rise[i];
        }
    }
    forAll(patch, i)
    {
        sums[patch.faceCells()[i]] +=
            mesh_.Sf().boundaryField()[patchi][i] * onFace[i];
    }
}


void Foam::sharpPressure::addWallSkewness(vectorField& slopes) const
{
    const vectorField first(slopes);
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (patch.coupled() || p_rgh_.boundaryField()[patchi].fixesValue())
        {
            continue;
        }
        const vectorField aside(patch.Cf() - patch.Cn() - patch.delta());
        forAll(patch, i)
        {
            const label celli = patch.faceCells()[i];
            slopes[celli] +=
                patch.Sf()[i] * (first[celli] & aside[i]) / mesh_.V()[celli];
        }
    }
}


Foam::tmp<Foam::volVectorField> Foam::sharpPressure::slopes() const
{
    tmp<volVectorField> tslopes(
        zeroCells<vector>(mesh_, "pressureSlopes", dimPressure / dimLength));
    vectorField& slopes = tslopes.ref().primitiveFieldRef();
    addInnerFaces(slopes);
    forAll(mesh_.boundary(), patchi)
    {
        addPatch(patchi, slopes);
    }
    slopes /= mesh_.V();
    addWallSkewness(slopes);
    tslopes.ref().correctBoundaryConditions();
    return tslopes;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sharpPressure::sharpPressure(
    const slurrySurface& surface, const volScalarField& p_rgh,
    const dimensionedVector& g, const dimensionedScalar& slurryDensity,
    const dimensionedScalar& airDensity,
    const dimensionedScalar& surfaceTension)
: surface_(surface),
  p_rgh_(p_rgh),
  mesh_(p_rgh.mesh()),
  g_(g),
  slurryDensity_(slurryDensity),
  airDensity_(airDensity),
  surfaceTension_(surfaceTension),
  density_(
      "sharpDensity",
      airDensity_ + surface_.wet() * (slurryDensity_ - airDensity_)),
  inertia_("inertia", density_),
  faceDensity_(
      "sharpFaceDensity",
      airDensity_ + surface_.wetLine() * (slurryDensity_ - airDensity_)),
  lineDensity_("lineDensity", faceDensity_),
  massWeights_("massWeights", mesh_.weights()),
  lineWeights_("lineWeights", mesh_.weights()),
  suction_(),
  jump_(zeroFaces(mesh_, "pressureJump", dimPressure))
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::sharpPressure::setSuction(const tmp<surfaceScalarField>& suction)
{
    suction_ = suction;
}


void Foam::sharpPressure::update(
    volScalarField& p_rgh, const volScalarField& mixtureDensity)
{
    const dimensionedScalar excess(slurryDensity_ - airDensity_);
    const volScalarField before(density_);
    setDensities(mixtureDensity);

    p_rgh.primitiveFieldRef() +=
        (before.primitiveField() - density_.primitiveField()) *
        (g_.value() & mesh_.C().primitiveField());
    refreshBoundary(p_rgh);

    const surfaceScalarField side(surface_.side());
    jump_ = -side * excess * surface_.potential(g_.value());
    if (surfaceTension_.value() > 0)
    {
        jump_ += surfaceTension_ * side * surface_.curvature();
    }
    if (suction_.valid())
    {
        jump_ -= side * suction_();
    }
    boundaryJumps(mixtureDensity);
}


Foam::tmp<Foam::surfaceScalarField>
Foam::sharpPressure::flux(const volVectorField& velocity) const
{
    tmp<surfaceScalarField> tflux(
        mesh_.Sf() & surfaceInterpolationScheme<vector>::interpolate(
                         velocity, tmp<surfaceScalarField>(massWeights_)));
    forAll(mesh_.boundary(), patchi)
    {
        if (isA<fixedFluxPressureFvPatchScalarField>(
                p_rgh_.boundaryField()[patchi]))
        {
            tflux.ref().boundaryFieldRef()[patchi] =
                mesh_.Sf().boundaryField()[patchi] &
                velocity.boundaryField()[patchi].patchInternalField();
        }
    }
    return tflux;
}


Foam::tmp<Foam::surfaceScalarField>
Foam::sharpPressure::faceRate(const volScalarField& coefficient) const
{
    return surfaceInterpolationScheme<scalar>::interpolate(
               coefficient, tmp<surfaceScalarField>(lineWeights_)) /
           faceDensity_;
}


Foam::tmp<Foam::surfaceScalarField>
Foam::sharpPressure::accelerationFlux(const volVectorField& force) const
{
    return (mesh_.Sf() & surfaceInterpolationScheme<vector>::interpolate(
                             force, tmp<surfaceScalarField>(lineWeights_))) /
           faceDensity_;
}


Foam::tmp<Foam::volVectorField>
Foam::sharpPressure::reconstruct(const surfaceScalarField& flux) const
{
    const surfaceVectorField& Sf = mesh_.Sf();
    const surfaceScalarField length(
        1 / (mesh_.nonOrthDeltaCoeffs() * mesh_.magSf()));
    tensorField areas(mesh_.nCells(), Zero);
    vectorField sums(mesh_.nCells(), Zero);
    const auto add = [&](const label celli, const scalar mass,
                         const scalar line, const vector& S, const scalar flow)
    {
        // A surface through the centre of a cell leaves its faces on one side
        // no mass. They keep a little, so that every direction has faces
        const scalar weight = max(mass, 0.01 * inertia_[celli]) * line;
        areas[celli] += weight * S * S;
        sums[celli] += weight * flow * S;
    };
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const scalar mass = faceDensity_[facei];
        const scalar own = massWeights_[facei] * mass;
        add(owner[facei], own, length[facei], Sf[facei], flux[facei]);
        add(neighbour[facei], mass - own, length[facei], Sf[facei],
            flux[facei]);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const labelUList& cells = mesh_.boundary()[patchi].faceCells();
        const scalarField mass(
            massWeights_.boundaryField()[patchi] *
            faceDensity_.boundaryField()[patchi]);
        forAll(cells, i)
        {
            add(cells[i], mass[i], length.boundaryField()[patchi][i],
                Sf.boundaryField()[patchi][i], flux.boundaryField()[patchi][i]);
        }
    }

    tmp<volVectorField> tresult(
        zeroCells<vector>(mesh_, "reconstructed", dimVelocity));
    tresult.ref().primitiveFieldRef() = inv(areas)() & sums;
    tresult.ref().correctBoundaryConditions();
    return tresult;
}


Foam::tmp<Foam::surfaceScalarField> Foam::sharpPressure::skewSlope() const
{
    return mesh_.nonOrthCorrectionVectors() &
           surfaceInterpolationScheme<vector>::interpolate(
               slopes(), tmp<surfaceScalarField>(lineWeights_));
}


Foam::tmp<Foam::volScalarField> Foam::sharpPressure::staticPressure() const
{
    tmp<volScalarField> tp(p_rgh_ + density_ * (g_ & mesh_.C()));
    // Across a patch that gives a pressure the density changes, too
    for (fvPatchScalarField& patch : tp.ref().boundaryFieldRef())
    {
        if (!patch.coupled())
        {
            patch += jump_.boundaryField()[patch.patch().index()];
        }
    }
    return tp;
}


// ************************************************************************* //
