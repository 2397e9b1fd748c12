/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryTracer.H"
#include "addToRunTimeSelectionTable.H"
#include "clock.H"
#include "IOdictionary.H"
#include "Switch.H"

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

//- Share of a cell from which on its slurry's concentration is judged
static constexpr scalar judged_ = 1e-3;

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
    if (!(tracer_.D() >= 0))
    {
        refuse("D", tracer_.D(), "0 m2/s or more");
    }
    if (!mesh_.solutionDict().subOrEmptyDict("solvers").found(name()))
    {
        FatalIOErrorInFunction(mesh_.solutionDict())
            << "solvers has no entry for the tracer " << name()
            << "; expected one, as for U, and nLimiterIter in it"
            << exit(FatalIOError);
    }
    if (!mesh_.solverDict(name()).found("nLimiterIter"))
    {
        FatalIOErrorInFunction(mesh_.solverDict(name()))
            << "the tracer " << name() << " has no nLimiterIter; expected"
            << " 'nLimiterIter 10;', the iterations of the limiter of its flux"
            << exit(FatalIOError);
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
    tracer_.begin(start, held);
    first_ = getProperty<scalar>("first", gSum(tracer_.content()));
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
  tracer_(name, fields_, dict.lookupOrDefault<scalar>("D", 0)),
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
    addPatches(fields_.flux(), tracer_.move(feed()));

    // The fields of this time were written before
    if (mesh_.time().writeTime())
    {
        tracer_.C().write();
        volScalarField held(heldName(), tracer_.C());
        held.primitiveFieldRef() = tracer_.content() / mesh_.V();
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
            const scalar share = tracer_.content()[celli] / slurry[celli];
            smallest = min(smallest, share);
            largest = max(largest, share);
        }
    }
    reduce(smallest, minOp<scalar>());
    reduce(largest, maxOp<scalar>());
    const scalar tracer = gSum(tracer_.content());
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
