/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "voidageContraction.H"
#include "fvcDiv.H"
#include "fvcGrad.H"
#include "fvcReconstruct.H"
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


//- Values at the faces out of the cells', with a normal component of their own
surfaceVectorField withNormal(
    const volVectorField& cells, const surfaceScalarField& normalComponent)
{
    const fvMesh& mesh = cells.mesh();
    const surfaceVectorField normal(mesh.Sf() / mesh.magSf());
    surfaceVectorField faces(fvc::interpolate(cells));
    faces += normal * (normalComponent - (normal & faces));
    return faces;
}


//- Slope of a head at the faces; normal to them as that of the pressure, so
//  that both keep each other in balance
surfaceVectorField slopeOf(const volScalarField& head)
{
    const fvMesh& mesh = head.mesh();
    const volVectorField slope(fvc::grad(head));
    return withNormal(
        slope, fv::snGradScheme<scalar>::snGrad(
                   head, mesh.nonOrthDeltaCoeffs(), "headSlope") +
                   (mesh.nonOrthCorrectionVectors() & fvc::interpolate(slope)));
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::tmp<Foam::surfaceVectorField>
Foam::voidageContraction::faceBedVelocity() const
{
    return fvc::interpolate(bed_.solidity() * bed_.velocity()) /
           max(fvc::interpolate(bed_.solidity()),
               dimensionedScalar("none", dimless, SMALL));
}


Foam::tmp<Foam::surfaceVectorField> Foam::voidageContraction::ofSide(
    const surfaceScalarField& flux, const scalar weight) const
{
    const volScalarField inverse(1 / voidage_);
    return flux * (fvc::interpolate(inverse) - sideValues(inverse, weight)) *
           sideValues(voidage_, weight) *
           (sideValues(U_, weight) - faceBedVelocity());
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::voidageContraction::voidageContraction(
    const movingBed& bed, const volScalarField& voidage,
    const volVectorField& U)
: bed_(bed),
  voidage_(voidage),
  U_(U),
  mesh_(U.mesh())
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::volVectorField>
Foam::voidageContraction::convection(const surfaceScalarField& flux) const
{
    const word scheme("div(rhoPhi,U)");
    if (bed_.empty())
    {
        return fvc::div(flux, U_, scheme);
    }
    tmp<volVectorField> tresult(
        fvc::div(flux * fvc::interpolate(1 / voidage_), voidage_ * U_, scheme));
    vectorField& result = tresult.ref().primitiveFieldRef();
    const surfaceVectorField ofOwner(ofSide(flux, 1));
    const surfaceVectorField ofNeighbour(ofSide(flux, 0));

    const scalarField& V = mesh_.V();
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const label own = owner[facei];
        const label nei = neighbour[facei];
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


Foam::tmp<Foam::surfaceScalarField> Foam::voidageContraction::contractionFlux(
    const surfaceScalarField& flux, const surfaceScalarField& faceDensity) const
{
    volScalarField head(0.5 / sqr(voidage_));
    extrapolate(head);
    const surfaceVectorField slope(slopeOf(head));
    const surfaceVectorField moved(
        withNormal(fvc::reconstruct(flux), flux / mesh_.magSf()));
    const surfaceScalarField through(
        (fvc::interpolate(voidage_ * U_) -
         fvc::interpolate(voidage_) * faceBedVelocity()) &
        mesh_.Sf());
    return -mesh_.time().deltaT() * (moved & slope) * through /
           (fvc::interpolate(1 / voidage_) * faceDensity);
}


// ************************************************************************* //
