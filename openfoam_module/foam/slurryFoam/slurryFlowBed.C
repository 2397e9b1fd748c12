/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryFlow.H"
#include "knownEntries.H"
#include "laminarModel.H"
#include "mixtureFluids.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::slurryFlow::readBed()
{
    Info << "Bed: " << bed_.description().c_str() << nl;
    if (!bedDict_.dictionary::empty())
    {
        wordList known({"drag", "voidageRate", "ballDensity", "poreSuction"});
        known.append(movingBed::entries());
        refuseMisspelt(bedDict_, known);
        bed_.requireSolids();
        if (voidageRate_ && bed_.jumps())
        {
            FatalIOErrorInFunction(bedDict_)
                << "inTime is window: the voidage jumps between windows, and"
                << " its rate, which moves the fluid, is infinite; expected"
                << " inTime smooth, or voidageRate no" << exit(FatalIOError);
        }

        if (!isA<laminarModel<incompressible::turbulenceModel>>(turbulence_()))
        {
            FatalErrorInFunction
                << "turbulenceProperties has " << turbulence_->type()
                << ", but no model is known for a flow between balls;"
                << " expected simulationType laminar" << exit(FatalError);
        }

        const fv::optionList& sources = fvOptions_;
        for (const fv::option& source : sources)
        {
            if (source.type() == "particleDrag" && source.active())
            {
                FatalIOErrorInFunction(bedDict_)
                    << "the balls drag the flow already, and constant/fvOptions"
                    << " has particleDrag " << source.name() << ", which would"
                    << " drag it again; expected one of them"
                    << exit(FatalIOError);
            }
        }

        const dictionary& drag = bedDict_.subDict("drag");
        requireKnownEntries(drag, bedDrag::entries());
        drag_.reset(new bedDrag(drag, fluidsOf(mixture_)));
        Info << "Drag: " << drag_->description().c_str() << nl;
        onBalls_.reset(new fluidOnBalls(
            mesh_,
            {drag_->law(), drag_->polydispersity(), mixture_.rho1().value(),
             mixture_.rho2().value(), g_.value(), drag_->viscosity(),
             !grates_.empty() || bedDict_.found("poreSuction") ||
                 !fvOptions_.optionList::empty()},
            [this] { return forcesOnBalls(); }));
    }
    if (bedDict_.found("poreSuction"))
    {
        suction_.reset(new poreSuction(
            bedDict_.subDict("poreSuction"), pressure_.surfaceTension()));
        pressure_.setSuction(suction_->atFaces(bed_));
        pressure_.update(p_rgh_, rho_);
    }
    if (bedDict_.found("ballDensity"))
    {
        load_.reset(new ballLoad(bedDict_, bed_, g_.value()));
    }
    Info << endl;
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


void Foam::slurryFlow::checkContinuity(
    const tmp<volScalarField::Internal>& before)
{
    // Solids on the cells of a mesh that moves are not known in space
    const bool known = before.valid() || !mesh_.moving();
    if (bed_.empty() || !voidageRate_ || !known || !mesh_.time().writeTime())
    {
        continuity_.clear();
        return;
    }
    const volScalarField::Internal& last =
        before.valid() ? before() : voidage_.oldTime().internalField();
    continuity_.reset(new solidsContinuity(bed_));
    continuity_->update(
        (last - voidage_.internalField()) / mesh_.time().deltaT(), alpha_, U_,
        mesh_.solver(p_rgh_.name()));
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slurryFlow::enter()
{
    clock_.begin("balls");
    if (mesh_.topoChanging())
    {
        FatalErrorInFunction
            << "the cells of the mesh changed, which slurryFoam cannot follow;"
            << " expected a mesh that moves with its cells kept"
            << exit(FatalError);
    }
    detailBefore_ = fluxDetail_;
    solution_.begin();
    if (mesh_.changing())
    {
        surface_.locate();
        pressure_.update(p_rgh_, rho_);
    }
    tmp<volScalarField::Internal> before;
    if (mesh_.moving() && bed_.inSpace())
    {
        before = bed_.voidageBefore();
    }
    if (!bed_.empty())
    {
        bed_.update();
        voidage_ = bed_.voidage();
        if (!voidageRate_)
        {
            dropRate(before);
        }
        if (suction_.valid())
        {
            pressure_.setSuction(suction_->atFaces(bed_));
        }
    }
    checkContinuity(before);
    if (before.valid())
    {
        const dimensionedScalar deltaT(mesh_.time().deltaT());
        const scalar counted = voidageRate_ ? 1 : 0;
        swept_.update(
            counted * (voidage_.internalField() - before()) / deltaT,
            p_rgh_.name());
    }
    else if (mesh_.moving())
    {
        swept_.update();
    }
    turning_.turn(U_, forces_);
}


void Foam::slurryFlow::tellBalls()
{
    if (!told_.valid())
    {
        return;
    }
    clock_.begin("balls");
    ballForces feel(onBalls_->present());
    if (!told_->takeUp(feel))
    {
        // What the flow loses: its drag has the factor of a mixture of sizes
        const scalarField exchange(
            drag_->exchange(bed_, alpha_.oldTime(), U_)->field());
        const vectorField force(
            mesh_.V() * (feel.solidity * feel.pressure +
                         exchange * (U_.primitiveField() - feel.velocity)));
        told_->keep(
            feel, gSum(force),
            gSum(
                (mesh_.C().primitiveField() ^ force)().component(vector::Z)()));
    }
    bed_.tell(feel, U_.primitiveField(), told_->torque());
}


// ************************************************************************* //
