/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryTracer.H"
#include "addToRunTimeSelectionTable.H"
#include "clock.H"
#include "CMULES.H"
#include "fvcFlux.H"
#include "fvcSurfaceIntegrate.H"
#include "fvmSup.H"
#include "gaussConvectionScheme.H"
#include "gaussLaplacianScheme.H"
#include "IOdictionary.H"
#include "linear.H"
#include "mixedFvPatchFields.H"
#include "oneField.H"
#include "Switch.H"
#include "uncorrectedSnGrad.H"
#include "upwind.H"
#include "zeroField.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(slurryTracer, 0);
addToRunTimeSelectionTable(functionObject, slurryTracer, dictionary);
} // End namespace functionObjects
} // End namespace Foam


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of a cell below which it holds no slurry that has a concentration
static constexpr scalar empty_ = 1e-9;

//- Share of a cell from which on its slurry's concentration is judged
static constexpr scalar judged_ = 1e-3;

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

void Foam::functionObjects::slurryTracer::check(const dictionary& dict) const
{
    slurryFields::refuseOthers(dict, {"begin", "length", "D"});
    const auto refuse =
        [&dict](const char* key, const scalar value, const char* expected)
    {
        FatalIOErrorInFunction(dict) << key << " is " << value << "; expected "
                                     << expected << exit(FatalIOError);
    };
    if (!(begin_ >= 0))
    {
        refuse("begin", begin_, "0 s or more");
    }
    if (!(length_ > 0))
    {
        refuse("length", length_, "more than 0 s");
    }
    if (!(D_ >= 0))
    {
        refuse("D", D_, "0 m2/s or more");
    }
    fields_.requireWholeFlux();
    const auto* bed = mesh_.findObject<IOdictionary>("bedProperties");
    if (bed && !bed->lookupOrDefault<Switch>("voidageRate", true))
    {
        FatalIOErrorInFunction(*bed)
            << "voidageRate is no; the tracer " << name()
            << " expects yes: without it slurry in a cell changes without a"
            << " flux" << exit(FatalIOError);
    }
}


Foam::tmp<Foam::scalarField>
Foam::functionObjects::slurryTracer::begun(const word& field) const
{
    const IOobject io(
        field, mesh_.time().timeName(), mesh_, IOobject::MUST_READ,
        IOobject::NO_WRITE, false);
    if (!IOobject(io).typeHeaderOk<volScalarField>(true))
    {
        return nullptr;
    }
    const volScalarField found(io, mesh_);
    return tmp<scalarField>::New(found.primitiveField());
}


void Foam::functionObjects::slurryTracer::begin()
{
    const Time& runTime = mesh_.time();
    const word time(runTime.timeName());
    const tmp<scalarField> start = begun(name());
    const tmp<scalarField> held = begun(heldName());
    if (held.valid() && !foundProperty("in"))
    {
        FatalErrorInFunction
            << "time " << time << " has the field " << heldName()
            << " of a run with the tracer " << name() << ", but not its sums in"
            << " uniform/functionObjects/functionObjectProperties; expected"
            << " both" << exit(FatalError);
    }
    if (foundProperty("in") && !(start.valid() && held.valid()))
    {
        FatalErrorInFunction
            << "time " << time << " was written with the tracer " << name()
            << ", but has not its fields " << name() << " and " << heldName()
            << "; expected both" << exit(FatalError);
    }
    if (!foundProperty("in") && runTime.timeIndex() > 0 && !start.valid() &&
        begin_ < runTime.value())
    {
        FatalErrorInFunction
            << "time " << time << " was written without the tracer " << name()
            << ", whose feed begins at " << begin_
            << " s; expected begin at this time or later" << exit(FatalError);
    }
    if (start.valid())
    {
        C_.primitiveFieldRef() = start();
    }
    if (gMin(C_.primitiveField()) < 0 || gMax(C_.primitiveField()) > 1)
    {
        FatalErrorInFunction
            << "the field " << name() << " of time " << time << " reaches from "
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
    first_ = getProperty<scalar>("first", gSum(content_));
}


void Foam::functionObjects::slurryTracer::writeColumns()
{
    writeHeader(file(), "Tracer in the slurry");
    writeHeaderValue(file(), "Begun", label(clock::getTime()));
    writeHeaderValue(file(), "Begin_s", begin_);
    writeHeaderValue(file(), "Length_s", length_);
    writeCommented(file(), "Time_s");
    for (const char* column :
         {"tracer_m3", "in_m3/s", "out_m3/s", "slurryIn_m3/s", "slurryOut_m3/s",
          "allIn_m3", "allOut_m3", "missing_m3", "smallest", "largest"})
    {
        writeTabbed(file(), column);
    }
    file() << endl;
}


Foam::scalar Foam::functionObjects::slurryTracer::feed() const
{
    const scalar last = mesh_.time().value();
    const scalar deltaT = mesh_.time().deltaTValue();
    const scalar from = max(last - deltaT, begin_);
    const scalar to = min(last, begin_ + length_);
    return max(to - from, scalar(0)) / deltaT;
}


void Foam::functionObjects::slurryTracer::setBoundary(
    const surfaceScalarField& F)
{
    const scalar value = feed();
    volScalarField::Boundary& C = C_.boundaryFieldRef();
    forAll(C, patchi)
    {
        if (isA<mixedFvPatchField<scalar>>(C[patchi]))
        {
            auto& patch = refCast<mixedFvPatchField<scalar>>(C[patchi]);
            patch.refValue() = value;
            patch.refGrad() = Zero;
            patch.valueFraction() = neg(F.boundaryField()[patchi]);
        }
    }
    C_.correctBoundaryConditions();
}


Foam::tmp<Foam::surfaceScalarField>
Foam::functionObjects::slurryTracer::dispersion() const
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


Foam::tmp<Foam::surfaceScalarField> Foam::functionObjects::slurryTracer::move(
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
    equation.solve(mesh_.solver(name()));

    surfaceScalarField flux(F * upstream.interpolate(C_));
    if (D_ > 0)
    {
        flux -= conductance() * mesh_.magSf() *
                fv::uncorrectedSnGrad<scalar>(mesh_).snGrad(C_);
    }
    surfaceScalarField better(
        fvc::flux(F, C_, "div(alphaPhi," + name() + ')') -
        F * upstream.interpolate(C_));
    MULES::limitCorr(
        1 / deltaT.value(), share, C_, F, better, zeroField(), zeroField(),
        oneField(), zeroField());
    flux += better;
    return tmp<surfaceScalarField>::New(flux);
}


void Foam::functionObjects::slurryTracer::addPatches(
    const surfaceScalarField& F, const surfaceScalarField& flux)
{
    in_ = out_ = slurryIn_ = slurryOut_ = 0;
    forAll(mesh_.boundary(), patchi)
    {
        if (!mesh_.boundary()[patchi].coupled())
        {
            const scalarField& tracer = flux.boundaryField()[patchi];
            const scalarField& slurry = F.boundaryField()[patchi];
            in_ -= sum(min(tracer, scalar(0)));
            out_ += sum(max(tracer, scalar(0)));
            slurryIn_ -= sum(min(slurry, scalar(0)));
            slurryOut_ += sum(max(slurry, scalar(0)));
        }
    }
    for (scalar* sum : {&in_, &out_, &slurryIn_, &slurryOut_})
    {
        reduce(*sum, sumOp<scalar>());
    }
    const scalar deltaT = mesh_.time().deltaTValue();
    allIn_ += deltaT * in_;
    allOut_ += deltaT * out_;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::slurryTracer::slurryTracer(
    const word& name, const Time& runTime, const dictionary& dict)
: fvMeshFunctionObject(name, runTime, dict),
  writeFile(mesh_, name, typeName, dict),
  fields_(mesh_, dict),
  begin_(dict.lookupOrDefault<scalar>("begin", 0)),
  length_(dict.lookupOrDefault<scalar>("length", GREAT)),
  D_(dict.lookupOrDefault<scalar>("D", 0)),
  C_(IOobject(
         name, runTime.timeName(), mesh_, IOobject::NO_READ,
         IOobject::NO_WRITE),
     mesh_, dimensionedScalar(dimless, Zero), tracerPatches(mesh_)),
  content_(mesh_.nCells(), Zero),
  in_(0),
  out_(0),
  slurryIn_(0),
  slurryOut_(0),
  first_(0),
  allIn_(getProperty<scalar>("in")),
  allOut_(getProperty<scalar>("out"))
{
    check(dict);
    begin();
    writeColumns();
    strict_.relax();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::slurryTracer::execute()
{
    const surfaceScalarField& F = fields_.flux();
    const scalarField slurry(fields_.volumes());
    setBoundary(F);
    const surfaceScalarField flux(move(F, slurry));

    // By what passed the faces, and not by the equation's solution
    content_ -= mesh_.time().deltaTValue() *
                fvc::surfaceIntegrate(flux)().primitiveField() * mesh_.V();
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
    addPatches(F, flux);

    // The fields of this time were written before
    if (mesh_.time().writeTime())
    {
        C_.write();
        volScalarField held(heldName(), C_);
        held.primitiveFieldRef() = content_ / mesh_.V();
        held.write();
    }
    setProperty("first", first_);
    setProperty("in", allIn_);
    setProperty("out", allOut_);
    return true;
}


bool Foam::functionObjects::slurryTracer::write()
{
    const scalarField slurry(fields_.volumes());
    scalar smallest = GREAT;
    scalar largest = -GREAT;
    forAll(slurry, celli)
    {
        if (slurry[celli] > judged_ * mesh_.V()[celli])
        {
            const scalar share = content_[celli] / slurry[celli];
            smallest = min(smallest, share);
            largest = max(largest, share);
        }
    }
    reduce(smallest, minOp<scalar>());
    reduce(largest, maxOp<scalar>());
    const scalar tracer = gSum(content_);
    writeCurrentTime(file());
    for (const scalar value :
         {tracer, in_, out_, slurryIn_, slurryOut_, allIn_, allOut_,
          tracer - first_ - allIn_ + allOut_})
    {
        file() << tab << value;
    }
    if (smallest <= largest)
    {
        file() << tab << smallest << tab << largest << endl;
    }
    else
    {
        file() << tab << "nan" << tab << "nan" << endl;
    }
    return true;
}


// ************************************************************************* //
