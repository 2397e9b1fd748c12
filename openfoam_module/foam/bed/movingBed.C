/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "movingBed.H"
#include "readableLog.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "resolutionAdvice.H"
#include "uncoveredCells.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::movingBed::beyond> Foam::movingBed::beyondNames_({
    {beyond::error, "error"},
    {beyond::warn, "warn"},
});


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::IOobject
Foam::movingBed::fieldIO(const word& name, const bool shown) const
{
    return IOobject(
        name, mesh_.time().timeName(), mesh_, IOobject::NO_READ,
        shown && !empty() ? IOobject::AUTO_WRITE : IOobject::NO_WRITE);
}


template <class Type>
Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>
Foam::movingBed::zero(
    const word& name, const dimensionSet& dimensions, const bool shown)
{
    return GeometricField<Type, fvPatchField, volMesh>(
        fieldIO(name, shown), mesh_, dimensioned<Type>(dimensions, Zero),
        extrapolatedCalculatedFvPatchField<Type>::typeName);
}


Foam::labelList Foam::movingBed::emptyCells() const
{
    labelHashSet cells;
    for (const word& name :
         dict_.lookupOrDefault<wordList>("emptyZones", wordList()))
    {
        const label zonei = mesh_.cellZones().findZoneID(name);
        if (zonei < 0)
        {
            FatalIOErrorInFunction(dict_)
                << "emptyZones names " << name << "; expected one of the mesh's"
                << " cell zones " << flatOutput(mesh_.cellZones().names())
                << ". millMesh makes pulpLifters" << exit(FatalIOError);
        }
        const cellZone& zone = mesh_.cellZones()[zonei];
        if (returnReduce(zone.size(), sumOp<label>()) == 0)
        {
            FatalIOErrorInFunction(dict_)
                << "emptyZones names " << name << ", which has no cells;"
                << " expected some. Check the box of topoSet, in m"
                << exit(FatalIOError);
        }
        cells.insert(zone);
    }
    return cells.sortedToc();
}


bool Foam::movingBed::sample(const scalar time, const bool moved)
{
    const bool changed = source_->sample(mesh_, time, moved, sums_);
    sums_.empty(empty_);
    return changed;
}


void Foam::movingBed::checkCover()
{
    labelHashSet missed(source_->uncovered());
    missed.unset(empty_);
    const labelList uncovered(missed.sortedToc());
    const label n = returnReduce(uncovered.size(), sumOp<label>());
    if (n == 0 || reported_)
        return;

    reported_ = true;
    readableText text;
    text << n << " of " << returnReduce(mesh_.nCells(), sumOp<label>())
         << " cells lie outside the grid of the solids: "
         << firstCells(mesh_, uncovered).c_str();
    if (uncovered_ == beyond::warn)
    {
        WarningInFunction << text.str().c_str() << "; they have no solids"
                          << endl;
        return;
    }
    FatalIOErrorInFunction(dict_)
        << text.str().c_str() << ". Average on a grid that covers the mesh"
        << " (millAverage --box, or --mesh), or let such cells have no solids"
        << " with the entry 'uncovered warn;'" << exit(FatalIOError);
}


void Foam::movingBed::setSolidity(scalarField& solidity)
{
    solidity = sums_.solidity();
    if (conservation_.valid() && source_->knowsVolume())
    {
        conservation_->correct(
            solidity, mesh_.V(), source_->volume(),
            [this] { return resolutionAdvice(mesh_, source_(), sums_); });
    }
}


void Foam::movingBed::setFields()
{
    scalarField& solidity = solidity_.primitiveFieldRef();
    setSolidity(solidity);
    vectorField& velocity = velocity_.primitiveFieldRef();
    scalarField& diameter = diameter_.primitiveFieldRef();
    scalarField& diameter43 = diameter43_.primitiveFieldRef();
    forAll(solidity, celli)
    {
        velocity[celli] = sums_.velocity(celli);
        diameter[celli] = sums_.diameter(celli);
        diameter43[celli] = sums_.diameter43(celli);
    }
    voidage_.primitiveFieldRef() = 1 - solidity;

    solidity_.correctBoundaryConditions();
    voidage_.correctBoundaryConditions();
    velocity_.correctBoundaryConditions();
    diameter_.correctBoundaryConditions();
    diameter43_.correctBoundaryConditions();
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::movingBed::movingBed(const dictionary& dict, const fvMesh& mesh)
: dict_(dict),
  mesh_(mesh),
  source_(solidsSource::New(dict_, mesh)),
  conservation_(
      dict_.lookupOrDefault<bool>("ledgerCorrection", true)
          ? new solidsConservation(dict_)
          : nullptr),
  uncovered_(beyondNames_.getOrDefault("uncovered", dict_, beyond::error)),
  empty_(emptyCells()),
  reported_(false),
  sums_(),
  solidity_(zero<scalar>("solidity", dimless, true)),
  voidage_(zero<scalar>("voidage", dimless, false)),
  velocity_(zero<vector>("solidsVelocity", dimVelocity, true)),
  diameter_(zero<scalar>("solidsDiameter", dimLength, true)),
  diameter43_(zero<scalar>("solidsDiameter43", dimLength, false)),
  updated_(-1),
  placed_(false)
{
    voidage_ == dimensionedScalar("voidage", dimless, 1);
    update();
    // From the first time-step on, d(voidage)/dt has its old level
    voidage_.oldTime();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::movingBed::update()
{
    const label now = mesh_.time().timeIndex();
    if (empty() || (updated_ == now && !mesh_.changing()))
        return;

    const bool moved = mesh_.changing() && !placed_;
    if (sample(mesh_.time().value(), moved) || mesh_.changing())
    {
        checkCover();
        setFields();
    }
    placed_ = false;
    if (updated_ != now && conservation_.valid() && source_->knowsVolume())
    {
        Info << "bed: " << conservation_->description().c_str() << endl;
    }
    updated_ = now;
}


Foam::tmp<Foam::volScalarField::Internal> Foam::movingBed::voidageBefore()
{
    sample(mesh_.time().value() - mesh_.time().deltaTValue(), mesh_.changing());
    checkCover();
    placed_ = true;

    auto tvoidage = tmp<volScalarField::Internal>::New(
        IOobject("voidageBefore", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimless, Zero));
    scalarField solidity;
    setSolidity(solidity);
    tvoidage.ref().field() = 1 - solidity;
    return tvoidage;
}


Foam::tmp<Foam::scalarField> Foam::movingBed::diameterOfBalls() const
{
    auto tresult = tmp<scalarField>::New(diameter_.primitiveField());
    scalarField& result = tresult.ref();
    const scalarField volume(solidity_.primitiveField() * mesh_.V());
    scalar surface = 0;
    forAll(result, celli)
    {
        surface += volume[celli] > 0 ? volume[celli] / result[celli] : 0;
    }
    reduce(surface, sumOp<scalar>());
    const scalar whole = surface > 0 ? gSum(volume) / surface : 0;
    forAll(result, celli)
    {
        if (!(volume[celli] > 0))
        {
            result[celli] = whole;
        }
    }
    return tresult;
}


Foam::wordList Foam::movingBed::entries()
{
    return {
        "exchange",
        "solids",
        "interpolation",
        "inTime",
        "outOfRange",
        "time0",
        "omega",
        "fingerprint",
        "block",
        "blocks",
        "uncovered",
        "emptyZones",
        "ledgerCorrection",
        "largestSolidity",
        "largestCorrection"};
}


void Foam::movingBed::requireSolids() const
{
    if (empty())
    {
        FatalIOErrorInFunction(dict_)
            << "neither of the entries 'solids' (the name of a solids.h5) and"
            << " 'block' (a uniform bed) is there; expected one of them"
            << exit(FatalIOError);
    }
}


void Foam::movingBed::addTo(millfoam::record::StepRow& row) const
{
    if (!empty() && conservation_.valid() && source_->knowsVolume())
    {
        row.volume_correction = conservation_->present();
        row.solids_moved = conservation_->moved();
    }
}


Foam::string Foam::movingBed::description() const
{
    if (empty())
    {
        return "no solids";
    }
    return source_->description() +
           (conservation_.valid() && source_->knowsVolume()
                ? ", volume corrected to the ledger's"
                : "");
}


// ************************************************************************* //
