/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "tracerTransport.H"
#include "CMULES.H"
#include "fvcFlux.H"
#include "fvcSurfaceIntegrate.H"
#include "fvmSup.H"
#include "gaussConvectionScheme.H"
#include "gaussLaplacianScheme.H"
#include "linear.H"
#include "mixedFvPatchFields.H"
#include "oneField.H"
#include "uncorrectedSnGrad.H"
#include "upwind.H"
#include "zeroField.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of a cell below which it holds no slurry that has a concentration
static constexpr scalar empty_ = 1e-9;

//- Patch types: coupled ones keep theirs, others get a value or its gradient
static wordList tracerPatches(const fvMesh& mesh)
{
    wordList types(mesh.boundary().size(), mixedFvPatchField<scalar>::typeName);
    forAll(types, patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        if (polyPatch::constraintType(patch.type()))
        {
            types[patchi] = patch.type();
        }
    }
    return types;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::tracerTransport::setBoundary(
    const surfaceScalarField& F, const scalar feed)
{
    volScalarField::Boundary& C = C_.boundaryFieldRef();
    forAll(C, patchi)
    {
        if (isA<mixedFvPatchField<scalar>>(C[patchi]))
        {
            auto& patch = refCast<mixedFvPatchField<scalar>>(C[patchi]);
            patch.refValue() = feed;
            patch.refGrad() = Zero;
            patch.valueFraction() = neg(F.boundaryField()[patchi]);
        }
    }
    C_.correctBoundaryConditions();
}


Foam::tmp<Foam::surfaceScalarField> Foam::tracerTransport::dispersion() const
{
    auto tresult = tmp<surfaceScalarField>::New(
        IOobject("tracerDispersion", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimArea / dimTime, Zero));
    surfaceScalarField& result = tresult.ref();
    volScalarField slurry(
        IOobject("slurryShare", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimless, Zero));
    slurry.primitiveFieldRef() =
        fields_.voidage() * fields_.alpha().primitiveField();
    slurry.correctBoundaryConditions();
    // Of two cells the one with less slurry: none passes the surface
    forAll(result, facei)
    {
        result[facei] = D_ * min(slurry[mesh_.owner()[facei]],
                                 slurry[mesh_.neighbour()[facei]]);
    }
    forAll(result.boundaryField(), patchi)
    {
        const fvPatchScalarField& patch = slurry.boundaryField()[patchi];
        if (patch.coupled())
        {
            result.boundaryFieldRef()[patchi] =
                D_ * min(patch.patchInternalField()(),
                         patch.patchNeighbourField()());
        }
    }
    return tresult;
}


Foam::tmp<Foam::surfaceScalarField> Foam::tracerTransport::solve(
    const surfaceScalarField& F, const scalarField& slurry)
{
    const dimensionedScalar deltaT(mesh_.time().deltaT());
    volScalarField::Internal share(
        IOobject("tracerShare", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimless, Zero));
    // In empty cells C is that of the step before
    share.field() = max((slurry / mesh_.V())(), empty_);
    volScalarField::Internal before(
        IOobject("tracerBefore", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimless, Zero));
    before.field() = content_ / mesh_.V() +
                     (share.field() - slurry / mesh_.V()) * C_.primitiveField();

    const tmp<surfaceScalarField> conductance(D_ > 0 ? dispersion() : nullptr);
    const upwind<scalar> upstream(mesh_, F);
    fv::gaussConvectionScheme<scalar> convection(
        mesh_, F,
        tmp<surfaceInterpolationScheme<scalar>>(new upwind<scalar>(mesh_, F)));
    fvScalarMatrix equation(
        fvm::Sp(share / deltaT, C_) + convection.fvmDiv(F, C_) ==
        before / deltaT);
    if (D_ > 0)
    {
        fv::gaussLaplacianScheme<scalar, scalar> diffusion(
            mesh_,
            tmp<surfaceInterpolationScheme<scalar>>(new linear<scalar>(mesh_)),
            tmp<fv::snGradScheme<scalar>>(
                new fv::uncorrectedSnGrad<scalar>(mesh_)));
        equation -= diffusion.fvmLaplacian(conductance(), C_);
    }
    equation.solve(mesh_.solver(C_.name()));

    surfaceScalarField flux(F * upstream.interpolate(C_));
    if (D_ > 0)
    {
        flux -= conductance() * mesh_.magSf() *
                fv::uncorrectedSnGrad<scalar>(mesh_).snGrad(C_);
    }
    surfaceScalarField better(
        fvc::flux(F, C_, "div(alphaPhi," + C_.name() + ')') -
        F * upstream.interpolate(C_));
    MULES::limitCorr(
        1 / deltaT.value(), share, C_, F, better, zeroField(), zeroField(),
        oneField(), zeroField());
    bound(
        better,
        content_ - deltaT.value() * mesh_.V() *
                       fvc::surfaceIntegrate(flux)().primitiveField(),
        slurry);
    flux += better;
    return tmp<surfaceScalarField>::New(flux);
}


void Foam::tracerTransport::bound(
    surfaceScalarField& correction, const scalarField& content,
    const scalarField& slurry) const
{
    // Of each cell: volumes that leave and enter, then the shares of them that
    // it allows
    volScalarField out(
        IOobject("tracerOut", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimless, Zero));
    volScalarField in("tracerIn", out);
    const scalar deltaT = mesh_.time().deltaTValue();
    const auto pass = [&](const label celli, const scalar flux)
    { (flux > 0 ? out : in)[celli] += deltaT * mag(flux); };
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(correction, facei)
    {
        pass(owner[facei], correction[facei]);
        pass(neighbour[facei], -correction[facei]);
    }
    for (const fvsPatchScalarField& patch : correction.boundaryField())
    {
        const labelUList& cells = patch.patch().faceCells();
        forAll(patch, facei)
        {
            pass(cells[facei], patch[facei]);
        }
    }
    forAll(slurry, celli)
    {
        const scalar held = max(content[celli], scalar(0));
        const scalar room = max(slurry[celli] - content[celli], scalar(0));
        out[celli] = min(scalar(1), held / max(out[celli], VSMALL));
        in[celli] = min(scalar(1), room / max(in[celli], VSMALL));
    }
    out.correctBoundaryConditions();
    in.correctBoundaryConditions();

    forAll(correction, facei)
    {
        const label own = owner[facei];
        const label nei = neighbour[facei];
        correction[facei] *= correction[facei] > 0 ? min(out[own], in[nei])
                                                   : min(in[own], out[nei]);
    }
    // Through other patches no correction passes
    for (fvsPatchScalarField& patch : correction.boundaryFieldRef())
    {
        if (patch.coupled())
        {
            const label patchi = patch.patch().index();
            const fvPatchScalarField& outs = out.boundaryField()[patchi];
            const fvPatchScalarField& ins = in.boundaryField()[patchi];
            patch *= pos(patch) * min(outs.patchInternalField()(),
                                      ins.patchNeighbourField()()) +
                     neg0(patch) * min(ins.patchInternalField()(),
                                       outs.patchNeighbourField()());
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::tracerTransport::tracerTransport(
    const word& name, const slurryFields& fields, const scalar D)
: fields_(fields),
  mesh_(fields.mesh()),
  D_(D),
  C_(IOobject(
         name, mesh_.time().timeName(), mesh_, IOobject::NO_READ,
         IOobject::NO_WRITE),
     mesh_, dimensionedScalar(dimless, Zero), tracerPatches(mesh_)),
  content_(mesh_.nCells(), Zero)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::tracerTransport::begin(
    const tmp<scalarField>& C, const tmp<scalarField>& held)
{
    if (C.valid())
    {
        C_.primitiveFieldRef() = C();
    }
    if (gMin(C_.primitiveField()) < 0 || gMax(C_.primitiveField()) > 1)
    {
        FatalErrorInFunction
            << "the field " << C_.name() << " of time "
            << mesh_.time().timeName() << " reaches from "
            << gMin(C_.primitiveField()) << " to " << gMax(C_.primitiveField())
            << "; expected a concentration from 0 to 1" << exit(FatalError);
    }
    if (held.valid())
    {
        content_ = held() * mesh_.V();
    }
    else
    {
        content_ = C_.primitiveField() * fields_.volumes();
    }
}


Foam::tmp<Foam::surfaceScalarField>
Foam::tracerTransport::move(const scalar feed)
{
    const surfaceScalarField& F = fields_.flux();
    const scalarField slurry(fields_.volumes());
    setBoundary(F, feed);
    const tmp<surfaceScalarField> flux(solve(F, slurry));

    // By what passed the faces, and not by the equation's solution
    content_ -= mesh_.time().deltaTValue() *
                fvc::surfaceIntegrate(flux())().primitiveField() * mesh_.V();
    scalarField& C = C_.primitiveFieldRef();
    forAll(C, celli)
    {
        if (slurry[celli] > empty_ * mesh_.V()[celli])
        {
            C[celli] = content_[celli] / slurry[celli];
        }
    }
    // Of next to no slurry the share is round-off
    C = min(max(C, scalar(0)), scalar(1));
    C_.correctBoundaryConditions();
    return flux;
}


// ************************************************************************* //
