/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "sweptFluid.H"
#include "coupledPatches.H"
#include "flowState.H"
#include "fvcDiv.H"
#include "gaussLaplacianScheme.H"
#include "surfaceInterpolate.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::dictionary Foam::sweptFluid::controls(const word& pressure) const
{
    const word& name = potential_.name();
    if (mesh_.solutionDict().subDict("solvers").found(name))
    {
        return mesh_.solver(name);
    }
    // The remainder stirs the fluid a little. It is in (1) of slurryFlow
    dictionary result(mesh_.solver(pressure));
    result.set("tolerance", 0.01);
    result.set("relTol", 0);
    return result;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sweptFluid::sweptFluid(const volScalarField& voidage, const bool kept)
: voidage_(voidage),
  mesh_(voidage.mesh()),
  flux_(
      IOobject("sweptFluid", mesh_.time().timeName(), mesh_), mesh_,
      dimensionedScalar(dimVolume / dimTime, Zero)),
  potential_(
      IOobject(
          "sweptPotential", mesh_.time().timeName(), mesh_,
          IOobject::READ_IF_PRESENT,
          kept ? IOobject::AUTO_WRITE : IOobject::NO_WRITE),
      mesh_, dimensionedScalar(dimArea / dimTime, Zero),
      zeroGradientFvPatchScalarField::typeName)
{
    if (kept)
    {
        requireState({potential_.name()}, mesh_);
    }
    evaluateCoupled(potential_);
    mesh_.setFluxRequired(potential_.name());
    flux_.setOriented();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField::Internal> Foam::sweptFluid::growth() const
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


Foam::tmp<Foam::volScalarField::Internal> Foam::sweptFluid::room() const
{
    tmp<volScalarField::Internal> trate(growth());
    if (mesh_.moving())
    {
        trate.ref() -= fvc::div(flux_)().internalField();
    }
    return trate;
}


void Foam::sweptFluid::update()
{
    flux_ = fvc::interpolate(voidage_) * mesh_.phi();
}


void Foam::sweptFluid::update(
    const volScalarField::Internal& bedRate, const word& pressure)
{
    update();
    volScalarField::Internal missing(room() - bedRate);
    // No potential moves fluid through the walls
    missing.field() -= gSum(missing.field() * mesh_.V()) / gSum(mesh_.V());

    fvScalarMatrix equation(
        fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
            mesh_.magSf(), mesh_.nonOrthDeltaCoeffs(), potential_) == missing);
    equation.setReference(Pstream::master() ? 0 : -1, potential_[0]);
    equation.solve(controls(pressure));
    flux_ += equation.flux();
}


// ************************************************************************* //
