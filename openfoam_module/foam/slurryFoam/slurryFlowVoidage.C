/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryFlow.H"
#include "fvcDiv.H"
#include "fvcGrad.H"
#include "fvcReconstruct.H"
#include "gaussLaplacianScheme.H"
#include "snGradScheme.H"
#include "surfaceInterpolate.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Values of the cell on one side of each face: the owner's with the weight 1,
//  the neighbour's with 0
template <class Type>
tmp<GeometricField<Type, fvsPatchField, surfaceMesh>> sideValues(
    const GeometricField<Type, fvPatchField, volMesh>& field,
    const scalar weight)
{
    const fvMesh& mesh = field.mesh();
    return surfaceInterpolationScheme<Type>::interpolate(
        field, tmp<surfaceScalarField>::New(
                   IOobject("sideWeights", mesh.time().timeName(), mesh), mesh,
                   dimensionedScalar("weight", dimless, weight)));
}


//- Boundary values out of the cells' slopes
void extrapolate(volScalarField& field)
{
    const volVectorField slope(fvc::grad(field));
    for (fvPatchScalarField& patch : field.boundaryFieldRef())
    {
        if (!patch.coupled())
        {
            patch == patch.patchInternalField() +
                         (slope.boundaryField()[patch.patch().index()]
                              .patchInternalField() &
                          (patch.patch().Cf() - patch.patch().Cn()));
        }
    }
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField::Internal> Foam::slurryFlow::fluidRate() const
{
    const dimensionedScalar deltaT(mesh_.time().deltaT());
    const volScalarField::Internal& before = voidage_.oldTime().internalField();
    if (mesh_.moving())
    {
        return (voidage_.internalField() - before * mesh_.V0() / mesh_.V()) /
               deltaT;
    }
    return (voidage_.internalField() - before) / deltaT;
}


void Foam::slurryFlow::dropRate(const tmp<volScalarField::Internal>& before)
{
    if (before.valid())
    {
        voidage_.oldTime().primitiveFieldRef() +=
            (voidage_.primitiveField() - before().field()) * mesh_.V() /
            mesh_.V0();
    }
    else
    {
        voidage_.oldTime() = voidage_;
    }
}


void Foam::slurryFlow::sweep(const tmp<volScalarField::Internal>& before)
{
    swept_ = fvc::interpolate(voidage_) * mesh_.phi();
    if (!before.valid())
    {
        return;
    }

    volScalarField::Internal missing(
        fluidRate() - fvc::div(swept_)().internalField());
    if (voidageRate_)
    {
        missing -=
            (voidage_.internalField() - before()) / mesh_.time().deltaT();
    }
    // No potential moves fluid through the walls
    missing.field() -= gSum(missing.field() * mesh_.V()) / gSum(mesh_.V());

    fvScalarMatrix equation(
        fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
            mesh_.magSf(), mesh_.nonOrthDeltaCoeffs(), sweptPotential_) ==
        missing);
    equation.setReference(Pstream::master() ? 0 : -1, sweptPotential_[0]);
    const word& name = sweptPotential_.name();
    if (mesh_.solutionDict().subDict("solvers").found(name))
    {
        equation.solve(mesh_.solver(name));
    }
    else
    {
        // What is left over stirs the fluid a little, and is in (1) all the same
        dictionary controls(mesh_.solver(p_rgh_.name()));
        controls.set("tolerance", 0.01);
        controls.set("relTol", 0);
        equation.solve(controls);
    }
    swept_ += equation.flux();
}


Foam::tmp<Foam::surfaceVectorField> Foam::slurryFlow::faceBedVelocity() const
{
    return fvc::interpolate(bed_.solidity() * bed_.velocity()) /
           max(fvc::interpolate(bed_.solidity()),
               dimensionedScalar("none", dimless, SMALL));
}


Foam::tmp<Foam::volVectorField>
Foam::slurryFlow::convection(const surfaceScalarField& flux) const
{
    const word scheme("div(rhoPhi,U)");
    if (bed_.empty())
    {
        return fvc::div(flux, U_, scheme);
    }
    tmp<volVectorField> tresult(
        fvc::div(flux * fvc::interpolate(1 / voidage_), voidage_ * U_, scheme));
    vectorField& result = tresult.ref().primitiveFieldRef();

    const volScalarField inverse(1 / voidage_);
    const surfaceScalarField faceInverse(fvc::interpolate(inverse));
    const surfaceVectorField balls(faceBedVelocity());
    const auto contraction = [&](const scalar side)
    {
        return surfaceVectorField(
            flux * (faceInverse - sideValues(inverse, side)) *
            sideValues(voidage_, side) * (sideValues(U_, side) - balls));
    };
    const surfaceVectorField ofOwner(contraction(1));
    const surfaceVectorField ofNeighbour(contraction(0));

    const scalarField& V = mesh_.V();
    forAll(mesh_.neighbour(), facei)
    {
        const label own = mesh_.owner()[facei];
        const label nei = mesh_.neighbour()[facei];
        result[own] -= ofOwner[facei] / V[own];
        result[nei] += ofNeighbour[facei] / V[nei];
    }
    forAll(mesh_.boundary(), patchi)
    {
        const labelUList& cells = mesh_.boundary()[patchi].faceCells();
        const vectorField& taken = ofOwner.boundaryField()[patchi];
        forAll(cells, i)
        {
            result[cells[i]] -= taken[i] / V[cells[i]];
        }
    }
    return tresult;
}


Foam::tmp<Foam::surfaceScalarField>
Foam::slurryFlow::contractionFlux(const surfaceScalarField& flux) const
{
    const surfaceVectorField normal(mesh_.Sf() / mesh_.magSf());
    const auto withNormal =
        [&normal](const volVectorField& cells, const surfaceScalarField& own)
    {
        surfaceVectorField faces(fvc::interpolate(cells));
        faces += normal * (own - (normal & faces));
        return faces;
    };

    // The slope normal to the face as that of the pressure, so that both keep
    // each other in balance
    volScalarField head(0.5 / sqr(voidage_));
    extrapolate(head);
    const volVectorField headSlope(fvc::grad(head));
    const surfaceVectorField slope(withNormal(
        headSlope,
        fv::snGradScheme<scalar>::snGrad(
            head, mesh_.nonOrthDeltaCoeffs(), "headSlope") +
            (mesh_.nonOrthCorrectionVectors() & fvc::interpolate(headSlope))));
    const surfaceVectorField moved(
        withNormal(fvc::reconstruct(flux), flux / mesh_.magSf()));

    const surfaceScalarField through(
        (fvc::interpolate(voidage_ * U_) -
         fvc::interpolate(voidage_) * faceBedVelocity()) &
        mesh_.Sf());
    return -mesh_.time().deltaT() * (moved & slope) * through /
           (fvc::interpolate(1 / voidage_) * pressure_.faceDensity());
}


// ************************************************************************* //
