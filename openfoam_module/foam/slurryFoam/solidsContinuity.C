/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsContinuity.H"
#include "readableLog.H"
#include "fvcDiv.H"
#include "fvcReconstruct.H"
#include "gaussLaplacianScheme.H"
#include "surfaceInterpolate.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Root of the weighted mean of squares; 0 without weights
scalar rootMean(const scalarField& squares, const scalarField& weights)
{
    return sqrt(gSum(squares * weights) / max(gSum(weights), VSMALL));
}


//- Flux of the solids; at walls and open patches they move as U there
tmp<surfaceScalarField>
solidsFlux(const movingBed& bed, const volVectorField& U)
{
    const volVectorField moved(bed.solidity() * bed.velocity());
    const surfaceVectorField& Sf = U.mesh().Sf();
    tmp<surfaceScalarField> tflux(fvc::interpolate(moved) & Sf);
    forAll(U.boundaryField(), patchi)
    {
        if (!U.boundaryField()[patchi].coupled())
        {
            tflux.ref().boundaryFieldRef()[patchi] =
                bed.solidity().boundaryField()[patchi] *
                (U.boundaryField()[patchi] & Sf.boundaryField()[patchi]);
        }
    }
    return tflux;
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsContinuity::solidsContinuity(const movingBed& bed)
: bed_(bed),
  residual_(0),
  driven_(0),
  slip_(0)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::solidsContinuity::update(
    const volScalarField::Internal& rate, const volScalarField& alpha,
    const volVectorField& U, const dictionary& controls)
{
    const fvMesh& mesh = U.mesh();
    const scalarField& solidity = bed_.solidity().primitiveField();
    volScalarField::Internal residual(
        rate + fvc::div(solidsFlux(bed_, U))().internalField());
    residual_ = rootMean(sqr(residual.field()), solidity * mesh.V());

    volScalarField potential(
        IOobject("solidsContinuity", mesh.time().timeName(), mesh), mesh,
        dimensionedScalar(dimArea / dimTime, Zero),
        zeroGradientFvPatchScalarField::typeName);
    mesh.setFluxRequired(potential.name());
    residual.field() -= gSum(residual.field() * mesh.V()) / gSum(mesh.V());
    fvScalarMatrix equation(
        fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
            mesh.magSf(), mesh.nonOrthDeltaCoeffs(), potential) == residual);
    equation.setReference(Pstream::master() ? 0 : -1, 0);
    equation.solve(controls);

    const volVectorField flow(fvc::reconstruct(equation.flux()));
    const scalarField slurry(
        pos(solidity - SMALL) * alpha.primitiveField() * (1 - solidity) *
        mesh.V());
    driven_ =
        rootMean(magSqr(flow.primitiveField()) / sqr(1 - solidity), slurry);
    slip_ = rootMean(
        magSqr(U.primitiveField() - bed_.velocity().primitiveField()), slurry);
}


Foam::string Foam::solidsContinuity::description() const
{
    readableText text;
    text << "continuity of the solids leaves " << residual_
         << " 1/s, which drives the slurry with " << driven_
         << " m/s; it slips with " << slip_ << " m/s";
    return text.str();
}


// ************************************************************************* //
