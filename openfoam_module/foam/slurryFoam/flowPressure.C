/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowPressure.H"
#include "fixedFluxPressureFvPatchScalarField.H"
#include "fvcDiv.H"
#include "gaussLaplacianScheme.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::flowPressure::makeRoom(
    volScalarField::Internal& room, const surfaceScalarField& free,
    const surfaceScalarField::Boundary& wallFlux)
{
    scalar total = gSum(room.field() * mesh_.V());
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatchScalarField& p = p_rgh_.boundaryField()[patchi];
        if (!p.coupled())
        {
            total += gSum(
                isA<fixedFluxPressureFvPatchScalarField>(p)
                    ? wallFlux[patchi]
                    : free.boundaryField()[patchi]);
        }
    }
    withoutRoom_ = -total * mesh_.time().deltaTValue();
    room.field() -= total / gSum(mesh_.V());
}


Foam::tmp<Foam::fvScalarMatrix> Foam::flowPressure::equation(
    const surfaceScalarField& conductance, const surfaceScalarField& given,
    const volScalarField::Internal& room)
{
    tmp<fvScalarMatrix> tequation(
        fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
            conductance, mesh_.nonOrthDeltaCoeffs(), p_rgh_) ==
        fvc::div(given)().internalField() + room);
    tequation.ref().setReference(Pstream::master() ? 0 : -1, p_rgh_[0]);
    return tequation;
}


void Foam::flowPressure::solve(
    fvScalarMatrix& equation, const dictionary& controls)
{
    clock_.begin("pressure solution");
    const solverPerformance solved(equation.solve(controls));
    clock_.begin("projection");
    iterations_ += solved.nIterations();
    residual_ = solved.finalResidual();
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::flowPressure::flowPressure(
    volScalarField& p_rgh, const sharpPressure& force, const bool fresh,
    millfoam::record::StageClock& clock)
: p_rgh_(p_rgh),
  force_(force),
  mesh_(p_rgh.mesh()),
  clock_(clock),
  fresh_(fresh),
  withoutRoom_(0),
  iterations_(0),
  residual_(0)
{
    mesh_.setFluxRequired(p_rgh_.name());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::surfaceScalarField> Foam::flowPressure::flux(
    surfaceScalarField& free, const surfaceScalarField& mobility,
    volScalarField::Internal& room,
    const surfaceScalarField::Boundary& wallFlux, pimpleControl& pimple)
{
    const surfaceScalarField conductance(mobility * mesh_.magSf());
    free -= conductance * mesh_.nonOrthDeltaCoeffs() * force_.jump();
    setSnGrad<fixedFluxPressureFvPatchScalarField>(
        p_rgh_.boundaryFieldRef(),
        (free.boundaryField() - wallFlux) / conductance.boundaryField());
    if (p_rgh_.needReference())
    {
        makeRoom(room, free, wallFlux);
    }

    // A fresh pressure knows its slopes after a first solution without the
    // faces' skewness
    if (fresh_)
    {
        solve(
            equation(conductance, free, room).ref(),
            mesh_.solver(p_rgh_.name()));
        fresh_ = false;
    }
    tmp<surfaceScalarField> tflux;
    while (pimple.correctNonOrthogonal())
    {
        const surfaceScalarField given(free - conductance * force_.skewSlope());
        tmp<fvScalarMatrix> tequation(equation(conductance, given, room));
        solve(
            tequation.ref(),
            mesh_.solver(p_rgh_.select(pimple.finalInnerIter())));
        if (pimple.finalNonOrthogonalIter())
        {
            tflux = given - tequation().flux();
        }
    }
    return tflux;
}


// ************************************************************************* //
