/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryFlow.H"
#include "constrainHbyA.H"
#include "fixedFluxPressureFvPatchScalarField.H"
#include "fvcDiv.H"
#include "fvcFlux.H"
#include "fvcSurfaceIntegrate.H"
#include "fvm.H"
#include "gaussConvectionScheme.H"
#include "gaussLaplacianScheme.H"
#include "upwind.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField> Foam::slurryFlow::massDensity() const
{
    tmp<volScalarField> tdensity(voidage_.oldTime() * rho_);
    if (mesh_.moving())
    {
        tdensity.ref().primitiveFieldRef() *= mesh_.V0() / mesh_.V();
    }
    return tdensity;
}


Foam::tmp<Foam::volScalarField> Foam::slurryFlow::dragForce() const
{
    auto tforce = tmp<volScalarField>::New(
        IOobject("dragForce", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimDensity / dimTime, Zero),
        zeroGradientFvPatchScalarField::typeName);
    if (drag_.valid())
    {
        tforce.ref().ref() =
            drag_->exchange(bed_, alpha_, U_) / voidage_.internalField();
        tforce.ref().correctBoundaryConditions();
    }
    return tforce;
}


Foam::tmp<Foam::surfaceScalarField> Foam::slurryFlow::keptDetail() const
{
    // Against the mass in a cell that which flow and friction exchange in a
    // step: what an implicit upwind equation of the detail would leave
    const surfaceScalarField friction(
        fvc::interpolate(voidage_ * rho_ * turbulence_->nuEff()) *
        mesh_.magSf() * mesh_.nonOrthDeltaCoeffs());
    const volScalarField exchanged(
        0.5 * fvc::surfaceSum(mag(massMoved_)) +
        mesh_.time().deltaT() * fvc::surfaceSum(friction));

    volScalarField share(
        IOobject("exchanged", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimless, Zero),
        zeroGradientFvPatchScalarField::typeName);
    share.ref() = exchanged.internalField() /
                  (massDensity()().internalField() * mesh_.V());
    share.correctBoundaryConditions();
    return 1 / (1 + fvc::interpolate(share));
}


Foam::tmp<Foam::volScalarField::Internal> Foam::slurryFlow::expulsion() const
{
    tmp<volScalarField::Internal> trate(fluidRate());
    if (mesh_.moving())
    {
        trate.ref() -= fvc::div(swept_)().internalField();
    }
    return trate;
}


void Foam::slurryFlow::makeRoom(
    volScalarField::Internal& rate, const surfaceScalarField& free,
    const surfaceScalarField::Boundary& wallFlux)
{
    scalar total = gSum(rate.field() * mesh_.V());
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
    misfit_ = total * mesh_.time().deltaTValue();
    rate.field() -= total / gSum(mesh_.V());
}


Foam::tmp<Foam::fvScalarMatrix> Foam::slurryFlow::pressureEquation(
    const surfaceScalarField& conductance, const surfaceScalarField& given,
    const volScalarField::Internal& rate)
{
    tmp<fvScalarMatrix> tequation(
        fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
            conductance, mesh_.nonOrthDeltaCoeffs(), p_rgh_) ==
        fvc::div(given)().internalField() + rate);
    tequation.ref().setReference(Pstream::master() ? 0 : -1, p_rgh_[0]);
    return tequation;
}


Foam::tmp<Foam::surfaceScalarField> Foam::slurryFlow::solvePressure(
    surfaceScalarField& free, const surfaceScalarField& mobility,
    pimpleControl& pimple)
{
    const surfaceScalarField conductance(mobility * mesh_.magSf());
    volScalarField::Internal rate(expulsion());
    free -= conductance * mesh_.nonOrthDeltaCoeffs() * pressure_.jump();

    const surfaceScalarField::Boundary wallFlux(
        (fvc::interpolate(voidage_) * (fvc::interpolate(U_) & mesh_.Sf()))()
            .boundaryField());
    setSnGrad<fixedFluxPressureFvPatchScalarField>(
        p_rgh_.boundaryFieldRef(),
        (free.boundaryField() - wallFlux) / conductance.boundaryField());
    if (p_rgh_.needReference())
    {
        makeRoom(rate, free, wallFlux);
    }

    // Without a pressure to go on from, its slopes are known after a first
    // solution without the faces' skewness
    if (fresh_)
    {
        pressureIterations_ += pressureEquation(conductance, free, rate)
                                   ->solve(mesh_.solver(p_rgh_.name()))
                                   .nIterations();
        fresh_ = false;
    }
    tmp<surfaceScalarField> tflux;
    while (pimple.correctNonOrthogonal())
    {
        const surfaceScalarField given(
            free - conductance * pressure_.skewSlope());
        tmp<fvScalarMatrix> tequation(
            pressureEquation(conductance, given, rate));
        const solverPerformance solved(tequation.ref().solve(
            mesh_.solver(p_rgh_.select(pimple.finalInnerIter()))));
        pressureIterations_ += solved.nIterations();
        pressureResidual_ = solved.finalResidual();
        if (pimple.finalNonOrthogonalIter())
        {
            tflux = given - tequation().flux();
        }
    }
    return tflux;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slurryFlow::predict(const pimpleControl& pimple)
{
    const dimensionedScalar deltaT(mesh_.time().deltaT());
    const volScalarField density("rho", massDensity());
    const surfaceScalarField flux("rhoPhi", massMoved_ / deltaT);
    const volScalarField::Internal before(
        density.internalField() / deltaT + fvc::div(flux)().internalField());

    // The scheme's part beyond upwind is explicit: where much slurry goes
    // through a cell of air, its matrix could not be solved
    const fv::gaussConvectionScheme<vector> upwinds(
        mesh_, flux,
        tmp<surfaceInterpolationScheme<vector>>(
            new upwind<vector>(mesh_, flux)));
    fvVectorMatrix equation(
        fvm::Sp(density.internalField() / deltaT, U_) +
            upwinds.fvmDiv(flux, U_) +
            (convection(flux) - upwinds.fvcDiv(flux, U_)) +
            turbulence_->divDevRhoReff(density, U_) ==
        before * U_.oldTime().internalField() +
            density.internalField() * forces_.internalField() +
            fvOptions_(density, U_));
    equation.relax();
    fvOptions_.constrain(equation);
    equation.solve(mesh_.solver(U_.select(pimple.finalInnerIter())));
    fvOptions_.correct(U_);
}


void Foam::slurryFlow::project(pimpleControl& pimple)
{
    const dimensionedScalar deltaT(mesh_.time().deltaT());

    const volVectorField carried(
        constrainHbyA(U_ - deltaT * forces_, U_, p_rgh_));
    const surfaceScalarField carriedFlux(pressure_.flux(voidage_ * carried));

    const surfaceScalarField seen(carriedFlux + keptDetail() * detailBefore_);

    volScalarField force(dragForce());
    volVectorField solidsVelocity(bed_.velocity());
    grates_.add(force, solidsVelocity, alpha_, U_);
    const surfaceScalarField r(deltaT * pressure_.faceRate(force));
    const surfaceScalarField faceVoidage(1 / fvc::interpolate(1 / voidage_));
    const surfaceScalarField drag(
        deltaT * faceVoidage *
        pressure_.accelerationFlux(force * (solidsVelocity - U_)));
    const surfaceScalarField contraction(contractionFlux(massMoved_ / deltaT));
    // Drops and films weigh what they hold: in p_rgh a dry cell weighs air
    const surfaceScalarField fall(
        deltaT * faceVoidage *
        fvc::flux(surface_.loose() * (1 - mixture_.rho2() / rho_) * g_));
    const surfaceScalarField before(
        pressure_.flux(voidage_ * U_) + fluxDetail_);

    surfaceScalarField free(
        (seen + contraction + fall + drag + r * before) / (1 + r));
    const surfaceScalarField mobility(
        deltaT * faceVoidage / (pressure_.faceDensity() * (1 + r)));
    phi_ = solvePressure(free, mobility, pimple);

    const volVectorField unseen(
        voidage_ * carried - pressure_.reconstruct(seen));
    U_ = (pressure_.reconstruct(phi_) +
          unseen / (1 + deltaT * force / pressure_.inertia())) /
         voidage_;
    U_.correctBoundaryConditions();
    fvOptions_.correct(U_);

    forces_ = (U_ - carried) / deltaT;
    fluxDetail_ = phi_ - pressure_.flux(voidage_ * U_);
    p_ = pressure_.staticPressure();
    if (mesh_.moving())
    {
        phi_ -= swept_;
    }
}


// ************************************************************************* //
