/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "bedDrag.H"
#include "knownEntries.H"
#include "openfoam_module/drag/pore_shear_rate.hpp"
#include "openfoam_module/drag/viscosity_ratio.hpp"

#include <algorithm>
#include <stdexcept>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Solidity below which a ball feels what it would at this one
static constexpr scalar smallSolidity_ = 1e-3;


//- Density and viscosity of a phase from its dictionary
static millfoam::drag::Fluid readFluid(const dictionary& dict)
{
    const millfoam::drag::Fluid fluid{
        dict.get<scalar>("rho"), dict.get<scalar>("mu")};
    if (!(fluid.density > 0 && fluid.viscosity > 0))
    {
        FatalIOErrorInFunction(dict)
            << "rho is " << fluid.density << " and mu is " << fluid.viscosity
            << "; expected both above zero" << exit(FatalIOError);
    }
    return fluid;
}


//- Slurry and air from the sub-dictionaries of those names
static bedFluids readFluids(const dictionary& dict)
{
    const dictionary& slurry = dict.subDict("slurry");
    requireKnownEntries(slurry, {"rho", "mu", "yieldStress", "viscosityRatio"});
    requireKnownEntries(dict.subDict("air"), {"rho", "mu"});
    const millfoam::drag::Fluid fluid(readFluid(slurry));
    const scalar ratio = slurry.lookupOrDefault<scalar>(
        "viscosityRatio", millfoam::drag::usual_viscosity_ratio);
    const scalar yieldStress = slurry.lookupOrDefault<scalar>("yieldStress", 0);
    if (!(yieldStress >= 0 && ratio >= 1))
    {
        FatalIOErrorInFunction(slurry)
            << "yieldStress is " << yieldStress << " Pa and viscosityRatio "
            << ratio << "; expected a yield stress of 0 or above and a ratio of"
            << " 1 or above" << exit(FatalIOError);
    }
    return {
        readFluid(dict.subDict("air")), fluid.density,
        millfoam::drag::FlowCurve::bingham(
            yieldStress, fluid.viscosity, ratio * fluid.viscosity)};
}


//- The law of that name
static const millfoam::drag::Law* readLaw(const dictionary& dict)
{
    const word name(dict.get<word>("law"));
    if (name == millfoam::drag::hoelzer_sommerfeld_law().name)
    {
        return &millfoam::drag::hoelzer_sommerfeld_law();
    }
    std::string reason;
    try
    {
        return &millfoam::drag::find_law(name);
    }
    catch (const std::invalid_argument& error)
    {
        reason = error.what();
    }
    FatalIOErrorInFunction(dict)
        << reason << ", "
        << word(std::string(millfoam::drag::hoelzer_sommerfeld_law().name))
        << exit(FatalIOError);
    return nullptr;
}


//- The list of vectors of that name, empty without it. Not by OpenFOAM's own
//  reader, which frees what it read by another type
static DynamicList<vector> readVectors(const dictionary& dict, const word& name)
{
    DynamicList<vector> result;
    if (!dict.found(name))
    {
        return result;
    }
    ITstream& stream = dict.lookup(name);
    stream.readBeginList(name.c_str());
    for (token next(stream); next != token::END_LIST; stream >> next)
    {
        if (next != token::BEGIN_LIST)
        {
            FatalIOErrorInFunction(dict)
                << name << " has " << next
                << " where a vector begins; expected ((x y z) ...)"
                << exit(FatalIOError);
        }
        stream.putBack(next);
        result.append(vector(stream));
    }
    return result;
}


//- The balls' shapes with their shares of the volume
static List<Tuple2<scalar, millfoam::drag::Shape>>
readShapes(const dictionary& dict)
{
    const DynamicList<vector> entries(readVectors(dict, "shapes"));
    if (entries.empty())
    {
        return {{1, {1, 1}}};
    }
    List<Tuple2<scalar, millfoam::drag::Shape>> shapes;
    scalar sum = 0;
    for (const vector& entry : entries)
    {
        const scalar share = entry.x();
        const millfoam::drag::Shape shape{entry.y(), entry.z()};
        if (!(share >= 0 && shape.sphericity > 0 && shape.sphericity <= 1 &&
              shape.crosswise_sphericity > 0))
        {
            FatalIOErrorInFunction(dict)
                << "shapes has " << entry << "; expected a share of the balls'"
                << " volume of 0 or above, a sphericity above 0 and up to 1,"
                << " and a crosswise sphericity above 0" << exit(FatalIOError);
        }
        sum += share;
        shapes.append({share, shape});
    }
    if (!(mag(sum - 1) < 1e-6))
    {
        FatalIOErrorInFunction(dict)
            << "the shares of volume in shapes add up to " << sum
            << "; expected 1" << exit(FatalIOError);
    }
    return shapes;
}

} // End namespace Foam


// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::bedDrag::mixture> Foam::bedDrag::mixtureNames_({
    {mixture::weights, "weights"},
    {mixture::permeability, "permeability"},
});


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

millfoam::drag::Fluid
Foam::bedDrag::slurryAt(const scalar phi, const scalar v, const scalar d) const
{
    return {
        fluids_.slurryDensity,
        viscosity_.at(millfoam::drag::pore_shear_rate(phi, v, d))};
}


Foam::scalar Foam::bedDrag::lawAt(
    const scalar phi, const scalar v, const scalar d,
    const millfoam::drag::Fluid& fluid) const
{
    using millfoam::drag::exchange_coefficient;

    scalar result = 0;
    if (law_ != &millfoam::drag::hoelzer_sommerfeld_law())
    {
        result = exchange_coefficient(*law_, phi, v, d, fluid);
    }
    else
    {
        for (const auto& shape : shapes_)
        {
            result += shape.first() *
                      exchange_coefficient(shape.second(), phi, v, d, fluid);
        }
    }
    if (result < 0)
    {
        FatalErrorInFunction
            << "the drag law " << law() << " is negative, " << result
            << " kg/(m3 s), at the solidity " << phi << " and Re "
            << millfoam::drag::reynolds(phi, v, d, fluid) << " (slip " << v
            << " m/s, diameter " << d << " m): far beyond its range it would"
            << " drive the fluid; expected another law in the entry law of drag"
            << " (millDrag --ranges)" << exit(FatalError);
    }
    return result;
}


Foam::scalar Foam::bedDrag::exchangeAt(
    const scalar share, const scalar phi, const scalar v, const scalar d) const
{
    const bool wet = share > 0;
    const bool dry = share < 1;
    const scalar slurry = wet ? lawAt(phi, v, d, slurryAt(phi, v, d)) : 0;
    const scalar air = dry ? lawAt(phi, v, d, fluids_.air) : 0;
    if (mixed_ == mixture::weights || !(wet && dry))
    {
        return share * slurry + (1 - share) * air;
    }
    // Without drag there is no resistance to share
    return slurry > 0 && air > 0
               ? 1 / (pow3(share) / slurry + pow3(1 - share) / air)
               : 0;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::bedDrag::bedDrag(const dictionary& dict, const bedFluids& fluids)
: law_(readLaw(dict)),
  shapes_(readShapes(dict)),
  range_(*law_),
  fluids_(fluids),
  viscosity_(dict, fluids.slurry),
  mixed_(mixtureNames_.getOrDefault("mixed", dict, mixture::weights)),
  polydispersity_(dict.lookupOrDefault<bool>("polydispersity", false)),
  multiplier_(dict.lookupOrDefault<scalar>("multiplier", 1)),
  solids_(0),
  largestRe_(0)
{
    if (!(multiplier_ >= 0))
    {
        FatalIOErrorInFunction(dict)
            << "multiplier is " << multiplier_
            << "; expected a factor on the drag, 0 or above"
            << exit(FatalIOError);
    }
}


Foam::bedDrag::bedDrag(const dictionary& dict)
: bedDrag(dict, readFluids(dict))
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::bedDrag::entries()
{
    return {"law",        "shapes", "viscosity", "polydispersity",
            "multiplier", "mixed"};
}


Foam::tmp<Foam::volScalarField::Internal> Foam::bedDrag::exchange(
    const movingBed& bed, const volScalarField& alpha,
    const volVectorField& U) const
{
    auto tresult = tmp<volScalarField::Internal>::New(
        IOobject("exchange", U.time().timeName(), U.mesh()), U.mesh(),
        dimensionedScalar(dimDensity / dimTime, Zero));
    volScalarField::Internal& result = tresult.ref();

    forAll(result, celli)
    {
        const scalar phi = bed.solidity()[celli];
        if (phi <= 0)
            continue;

        const scalar v = mag(bed.velocity()[celli] - U[celli]);
        const scalar d = bed.diameter()[celli];
        const scalar share = max(scalar(0), min(alpha[celli], scalar(1)));
        scalar beta = exchangeAt(share, phi, v, d);
        if (polydispersity_)
        {
            beta *= millfoam::drag::polydispersity_factor(
                phi, d, bed.diameter43()[celli]);
        }
        result[celli] = multiplier_ * beta;
    }
    return tresult;
}


Foam::tmp<Foam::scalarField> Foam::bedDrag::ballExchange(
    const movingBed& bed, const volScalarField& alpha,
    const volVectorField& U) const
{
    auto tresult = tmp<scalarField>::New(bed.diameterOfBalls());
    scalarField& result = tresult.ref();
    forAll(result, celli)
    {
        const scalar d = result[celli];
        const scalar phi = max(bed.solidity()[celli], smallSolidity_);
        const scalar v = mag(bed.velocity()[celli] - U[celli]);
        const scalar share = max(scalar(0), min(alpha[celli], scalar(1)));
        result[celli] =
            d > 0 ? multiplier_ * exchangeAt(share, phi, v, d) / phi : 0;
    }
    return tresult;
}


void Foam::bedDrag::report(
    const movingBed& bed, const volScalarField& alpha, const volVectorField& U,
    const string& who)
{
    largestRe_ = 0;
    range_.begin();
    const scalarField& V = U.mesh().V();
    forAll(V, celli)
    {
        const scalar phi = bed.solidity()[celli];
        if (phi <= 0 || alpha[celli] <= 0.5)
            continue;

        const scalar v = mag(bed.velocity()[celli] - U[celli]);
        const scalar d = bed.diameter()[celli];
        const scalar re =
            millfoam::drag::reynolds(phi, v, d, slurryAt(phi, v, d));
        largestRe_ = max(largestRe_, re);
        range_.count(phi, re, (1 - phi) * V[celli]);
    }
    reduce(largestRe_, maxOp<scalar>());
    range_.end(U.time().deltaTValue());

    solids_ = gSum(bed.solidity().primitiveField() * V);
    Info << who.c_str() << ": solids " << solids_
         << " m3, largest particle Re in slurry " << largestRe_ << ", "
         << range_.description().c_str() << endl;
}


void Foam::bedDrag::summary(const string& who) const
{
    Info << who.c_str() << ": " << range_.summary().c_str() << endl;
}


Foam::string Foam::bedDrag::description() const
{
    const auto isSphere = [](const Tuple2<scalar, millfoam::drag::Shape>& one)
    {
        return one.second().sphericity == 1 &&
               one.second().crosswise_sphericity == 1;
    };
    const bool takesShapes = law_ == &millfoam::drag::hoelzer_sommerfeld_law();
    const bool spheres = std::all_of(shapes_.begin(), shapes_.end(), isSphere);
    return "drag law " + std::string(law_->name) + " (" +
           std::string(law_->reference) + ")" +
           (takesShapes || spheres
                ? ""
                : ", which takes all balls for spheres and not their shapes");
}


millfoam::record::Drag Foam::bedDrag::forRecord() const
{
    millfoam::record::Drag result;
    result.law = law_->name;
    result.reference = law_->reference;
    result.multiplier = multiplier_;
    result.viscosity = viscosity_.name();
    result.polydispersity = polydispersity_;
    result.mixed = mixtureNames_[mixed_];
    result.solidity_min = law_->range.phi_min;
    result.solidity_max = law_->range.phi_max;
    result.reynolds_min = law_->range.re_min;
    result.reynolds_max = law_->range.re_max;
    return result;
}


void Foam::bedDrag::addTo(millfoam::record::StepRow& row) const
{
    const lawRange::shares shares = range_.present();
    row.solids = solids_;
    row.largest_reynolds = largestRe_;
    row.beyond_law = shares.outside;
    row.solidity_below = shares.phiLow;
    row.solidity_above = shares.phiHigh;
    row.reynolds_below = shares.reLow;
    row.reynolds_above = shares.reHigh;
}


// ************************************************************************* //
