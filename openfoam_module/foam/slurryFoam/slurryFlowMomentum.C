/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryFlow.H"
#include "constrainHbyA.H"
#include "findRefCell.H"
#include "fvcDiv.H"
#include "fvcFlux.H"
#include "fvcSurfaceIntegrate.H"
#include "fvm.H"
#include "gaussConvectionScheme.H"
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


Foam::tmp<Foam::volScalarField::Internal>
Foam::slurryFlow::carriedDensity() const
{
    const surfaceFilms& films = surface_.films();
    return (1 - films.loose().internalField() - films.film().internalField()) *
           (pressure_.inertia().internalField() -
            pressure_.density().internalField());
}


Foam::tmp<Foam::volScalarField> Foam::slurryFlow::dragForce(
    const volScalarField& alpha, const volVectorField& U,
    volVectorField& solids) const
{
    auto tforce = tmp<volScalarField>::New(
        IOobject("dragForce", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimDensity / dimTime, Zero),
        zeroGradientFvPatchScalarField::typeName);
    if (drag_.valid())
    {
        tforce.ref().ref() =
            drag_->exchange(bed_, alpha, U) / voidage_.internalField();
        tforce.ref().correctBoundaryConditions();
    }
    solids = bed_.velocity();
    grates_.add(tforce.ref(), solids, alpha, U);
    return tforce;
}


Foam::tmp<Foam::volScalarField> Foam::slurryFlow::dragStiffness(
    const volScalarField& force, const volVectorField& solids) const
{
    const scalar share = 0.01;
    volVectorField same(solids);
    const volScalarField faster(
        dragForce(alpha_, U_ + share * (U_ - solids), same));
    return force +
           max(faster - force, dimensionedScalar(force.dimensions(), Zero)) /
               share;
}


Foam::tmp<Foam::vectorField> Foam::slurryFlow::pressureForce() const
{
    // The projection saw the slurry of the step's begin
    volVectorField solids(bed_.velocity());
    const volScalarField force(dragForce(alpha_.oldTime(), U_, solids));
    // What the contraction does at the faces is no force but convection
    const volVectorField contraction(
        pressure_.reconstruct(contractionFlux_) /
        (mesh_.time().deltaT() * voidage_));
    tmp<vectorField> tresult =
        projectedDensity_.field() *
            (forces_.primitiveField() - contraction.primitiveField() -
             g_.value()) +
        force.primitiveField() *
            (U_.primitiveField() - solids.primitiveField());
    if (carryingForce_.valid())
    {
        tresult.ref() += carryingForce_().field();
    }
    return tresult;
}


Foam::ballForces Foam::slurryFlow::forcesOnBalls() const
{
    return {
        bed_.solidity().primitiveField(), vectorField(pressureForce()),
        scalarField(drag_->ballExchange(bed_, alpha_.oldTime(), U_)),
        bed_.velocity().primitiveField(), scalarField(bed_.diameterOfBalls())};
}


Foam::tmp<Foam::surfaceScalarField> Foam::slurryFlow::keptDetail() const
{
    // The mass that flow and friction exchange in a step, relative to the mass
    // in a cell: an implicit upwind equation of the detail would leave as much
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


Foam::slurryFlow::faceDrag Foam::slurryFlow::bodyDrag(
    const volScalarField& force, const volVectorField& solidsVelocity,
    const surfaceScalarField& faceVoidage) const
{
    const dimensionedScalar deltaT(mesh_.time().deltaT());
    return {
        surfaceScalarField(
            deltaT * faceVoidage *
            pressure_.accelerationFlux(force * (solidsVelocity - U_))),
        surfaceScalarField(
            deltaT * pressure_.faceRate(dragStiffness(force, solidsVelocity)))};
}


void Foam::slurryFlow::addPlates(
    faceDrag& drag, const surfaceScalarField& before,
    const surfaceScalarField& faceVoidage) const
{
    if (!grates_.plates())
    {
        return;
    }
    surfaceScalarField rate(
        mesh_.time().deltaT() * faceVoidage *
        grates_.resistance(before, alpha_) / pressure_.faceDensity());
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatchScalarField& p = p_rgh_.boundaryField()[patchi];
        if (!p.coupled() && !p.fixesValue())
        {
            rate.boundaryFieldRef()[patchi] = 0;
        }
    }
    drag.flux -= rate * before;
    drag.r += 2 * rate; // quadratic
}


Foam::tmp<Foam::surfaceScalarField>
Foam::slurryFlow::fall(const surfaceScalarField& faceVoidage) const
{
    // Drops fall, and films go where their level is lower: p_rgh sees neither,
    // as a dry cell weighs air in it
    const volScalarField held(1 - mixture_.rho2() / rho_);
    const surfaceFilms& films = surface_.films();
    return mesh_.time().deltaT() * faceVoidage *
           (fvc::flux(films.loose() * held * g_) -
            mag(g_) * fvc::interpolate(held) * films.rise() *
                mesh_.nonOrthDeltaCoeffs() * mesh_.magSf());
}


void Foam::slurryFlow::setGivenFluxes(
    surfaceScalarField& free,
    const surfaceScalarField::Boundary& wallFlux) const
{
    forAll(wallFlux, patchi)
    {
        if (U_.boundaryField()[patchi].fixesValue() &&
            isA<zeroGradientFvPatchScalarField>(p_rgh_.boundaryField()[patchi]))
        {
            free.boundaryFieldRef()[patchi] = wallFlux[patchi];
        }
    }
}


void Foam::slurryFlow::setReference(const pimpleControl& pimple)
{
    if (!p_rgh_.needReference())
    {
        return;
    }
    const dictionary& controls = pimple.dict();
    label cell = -1;
    scalar value = controls.lookupOrDefault<scalar>("pRefValue", 0);
    scalar present = 0;
    if (controls.found("pRefCell") || controls.found("pRefPoint"))
    {
        setRefCell(p_, p_rgh_, controls, cell, value);
        present = getRefCellValue(p_, cell);
    }
    else
    {
        const scalarField air(
            max(1 - alpha_.primitiveField(), scalar(1e-9)) *
            voidage_.primitiveField() * mesh_.V());
        present = gSum(air * p_.primitiveField()) / gSum(air);
    }
    const dimensionedScalar lack("lack", dimPressure, value - present);
    p_rgh_ += lack;
    p_ += lack;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slurryFlow::predict(const pimpleControl& pimple)
{
    clock_.begin("momentum");
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
            (contraction_.convection(flux) - upwinds.fvcDiv(flux, U_)) +
            turbulence_->divDevRhoReff(density, U_) ==
        before * U_.oldTime().internalField() +
            density.internalField() * forces_.internalField() +
            fvOptions_(density, U_));
    if (auto lack = turning_.lack())
    {
        equation -= density.internalField() * lack;
    }
    if (auto centripetal = turning_.centripetal())
    {
        carryingForce_ = carriedDensity() * centripetal;
        equation -=
            density.internalField() / rho_.internalField() * carryingForce_();
    }
    equation.relax();
    fvOptions_.constrain(equation);
    equation.solve(mesh_.solver(U_.select(pimple.finalInnerIter())));
    fvOptions_.correct(U_);
}


void Foam::slurryFlow::project(pimpleControl& pimple)
{
    clock_.begin("projection");
    const dimensionedScalar deltaT(mesh_.time().deltaT());

    const volVectorField carried(
        constrainHbyA(U_ - deltaT * forces_, U_, p_rgh_));
    const surfaceScalarField carriedFlux(pressure_.flux(voidage_ * carried));

    const surfaceScalarField seen(carriedFlux + keptDetail() * detailBefore_);

    volVectorField solidsVelocity(bed_.velocity());
    const volScalarField force(dragForce(alpha_, U_, solidsVelocity));
    const surfaceScalarField faceVoidage(1 / fvc::interpolate(1 / voidage_));
    const surfaceScalarField before(
        pressure_.flux(voidage_ * U_) + fluxDetail_);
    faceDrag drag(bodyDrag(force, solidsVelocity, faceVoidage));
    addPlates(drag, before, faceVoidage);
    contractionFlux_ = contraction_.contractionFlux(
        massMoved_ / deltaT, pressure_.faceDensity());
    projectedDensity_ = rho_.internalField();
    surfaceScalarField free(
        (seen + contractionFlux_ + fall(faceVoidage) + drag.flux +
         drag.r * before) /
        (1 + drag.r));
    const surfaceScalarField mobility(
        deltaT * faceVoidage / (pressure_.faceDensity() * (1 + drag.r)));
    const surfaceScalarField::Boundary wallFlux(
        (fvc::interpolate(voidage_) * (fvc::interpolate(U_) & mesh_.Sf()))()
            .boundaryField());
    setGivenFluxes(free, wallFlux);
    volScalarField::Internal room(swept_.room());
    phi_ = solution_.flux(free, mobility, room, wallFlux, pimple);

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
    setReference(pimple);
    if (mesh_.moving())
    {
        phi_ -= swept_.flux();
    }
}


// ************************************************************************* //
