/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryFlow.H"
#include "fvcReconstruct.H"
#include "fvcSurfaceIntegrate.H"
#include "geometricOneField.H"
#include "MULES.H"
#include "oneField.H"
#include "subCycle.H"
#include "zeroField.H"

// * * * * * * * * * * * * * * Local Definitions * * * * * * * * * * * * * * //

namespace Foam
{

//- Of a step in which slurry is carried
static constexpr label mostParts_ = 20;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::label Foam::slurryFlow::surfaceSteps(const scalarField& smaller) const
{
    const scalarField given(
        0.5 * fvc::surfaceSum(mag(phi_))().primitiveField() +
        0.5 * fvc::surfaceIntegrate(phi_)().primitiveField() * mesh_.V());
    const scalar largest =
        gMax((given / smaller)()) * mesh_.time().deltaTValue();
    if (largest > mostParts_)
    {
        WarningInFunction
            << "a cell gives away " << largest << " times its fluid in a step;"
            << " slurry is carried in " << mostParts_ << " parts, which may"
            << " leave shares beyond 0 to 1: expected shorter steps" << endl;
    }
    return largest >= mostParts_ ? mostParts_
                                 : max(label(1), label(std::ceil(largest)));
}


void Foam::slurryFlow::carrySlurry(const vectorField& relative)
{
    // Not within the sub-cycles, where a field's old time is another one
    const scalarField first(
        voidage_.oldTime().primitiveField() *
        (mesh_.moving() ? mesh_.V0().field() : mesh_.V().field()));
    const scalarField last(voidage_.primitiveField() * mesh_.V());
    const label steps = surfaceSteps(min(first, last));
    // A patch where the flow has turned lets in what is beyond it
    alpha_.correctBoundaryConditions();
    volScalarField voidage("voidage", voidage_);
    surfaceScalarField carried("carried", 0 * slurryFlux_);
    label step = 0;
    for (subCycle<volScalarField> part(alpha_, steps); !(++part).end(); ++step)
    {
        const scalarField now(
            mesh_.moving() ? mesh_.Vsc()().field() : mesh_.V().field());
        const scalarField before(
            mesh_.moving() ? mesh_.Vsc0()().field() : mesh_.V().field());
        voidage.oldTime().primitiveFieldRef() =
            (first + scalar(step) / steps * (last - first)) / before;
        voidage.primitiveFieldRef() =
            (first + scalar(step + 1) / steps * (last - first)) / now;

        slurryFlux_ = transport_.flux(phi_, relative);
        MULES::explicitSolve(
            voidage, alpha_, phi_, slurryFlux_, zeroField(), zeroField(),
            oneField(), zeroField());
        if (step + 1 < steps)
        {
            surface_.findNormals();
        }
        else
        {
            surface_.reconstruct();
        }
        carried += slurryFlux_ / steps;
    }
    slurryFlux_ = carried;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slurryFlow::transport()
{
    clock_.begin("surface");
    const vectorField relative(
        fvc::reconstruct(phi_)().primitiveField() / voidage_.primitiveField());
    carrySlurry(relative);

    turning_.keep();
    massMoved_ = mesh_.time().deltaT() *
                 (slurryFlux_ * (mixture_.rho1() - mixture_.rho2()) +
                  phi_ * mixture_.rho2());

    surface_.locate();
    rho_ = alpha_ * mixture_.rho1() + (1.0 - alpha_) * mixture_.rho2();
    pressure_.update(p_rgh_, rho_);
    mixture_.correct();
    if (!newtonianStress_)
    {
        turbulence_->correct();
    }
    keepState();
}


// ************************************************************************* //
