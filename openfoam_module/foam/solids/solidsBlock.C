/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsBlock.H"
#include "readableLog.H"
#include "knownEntries.H"
#include "Tuple2.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::solidsBlock::cells> Foam::solidsBlock::cellsNames_({
    {cells::centre, "centre"},
    {cells::overlap, "overlap"},
});


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::solidsBlock::readMotion(const dictionary& dict)
{
    moves_ = dict.lookupOrDefault<bool>("moves", false);
    until_ = dict.lookupOrDefault<scalar>("until", GREAT);
    if (dict.found("until") && !moves_)
    {
        FatalIOErrorInFunction(dict)
            << "until is " << until_ << " s, but the block rests; expected"
            << " 'moves yes;' with it" << exit(FatalIOError);
    }

    const scalar omega = dict.lookupOrDefault<scalar>("omega", 0);
    if (omega != 0)
    {
        const vector axis(dict.get<vector>("axis"));
        if (!(mag(axis) > 0))
        {
            FatalIOErrorInFunction(dict)
                << "axis is " << axis << "; expected a direction to turn about"
                << " with omega " << omega << exit(FatalIOError);
        }
        omega_ = omega * axis / mag(axis);
        origin_ = dict.get<vector>("origin");
    }
    if (moves_ && (omega != 0 || !shape_->exact()))
    {
        FatalIOErrorInFunction(dict)
            << "moves is yes, but only a box with omega 0 can be carried along;"
            << " expected moves no, where the block stays in its place and its"
            << " balls move through it" << exit(FatalIOError);
    }

    if (dict.found("ramp"))
    {
        requireKnownEntries(dict.subDict("ramp"), {"time"});
        const Tuple2<scalar, scalar> times(dict.subDict("ramp").lookup("time"));
        rampBegin_ = times.first();
        rampEnd_ = times.second();
        if (!(rampEnd_ > rampBegin_))
        {
            FatalIOErrorInFunction(dict)
                << "the ramp's time is (" << rampBegin_ << " " << rampEnd_
                << "); expected the earlier first" << exit(FatalIOError);
        }
    }
}


void Foam::solidsBlock::check(const dictionary& dict) const
{
    wordList known(
        {"solidity", "diameter", "velocity", "moves", "until", "omega",
         "origin", "axis", "ramp", "cells", "volume"});
    known.append(shape_->entries());
    requireKnownEntries(dict, known);
    if (!(solidity_ >= 0 && solidity_ < 1))
    {
        FatalIOErrorInFunction(dict)
            << "solidity is " << solidity_ << "; expected 0 <= solidity < 1"
            << exit(FatalIOError);
    }
    if (!(diameter_ > 0))
    {
        FatalIOErrorInFunction(dict)
            << "diameter is " << diameter_ << "; expected a length above 0 m"
            << exit(FatalIOError);
    }
    if (dict.found("volume") && !(volume_ > 0))
    {
        FatalIOErrorInFunction(dict)
            << "volume is " << volume_ << "; expected that of the whole block's"
            << " balls, above 0 m3" << exit(FatalIOError);
    }
}


Foam::scalar Foam::solidsBlock::grown(const scalar t) const
{
    const scalar share = max(
        scalar(0), min((t - rampBegin_) / (rampEnd_ - rampBegin_), scalar(1)));
    return pow3(share) * (10 - 15 * share + 6 * sqr(share));
}


Foam::vector Foam::solidsBlock::displacement(const scalar t) const
{
    return moves_ ? min(t, until_) * velocity_ : vector::zero;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsBlock::solidsBlock(const dictionary& dict)
: shape_(blockShape::New(dict)),
  solidity_(dict.get<scalar>("solidity")),
  diameter_(dict.get<scalar>("diameter")),
  velocity_(dict.get<vector>("velocity")),
  moves_(false),
  until_(GREAT),
  omega_(Zero),
  origin_(Zero),
  rampBegin_(-2 * GREAT),
  rampEnd_(-GREAT),
  cells_(cells::centre),
  volume_(dict.lookupOrDefault<scalar>("volume", -1))
{
    check(dict);
    readMotion(dict);
    cells_ = cellsNames_.getOrDefault(
        "cells", dict, moves_ ? cells::overlap : cells::centre);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::solidsBlock::changes(const scalar a, const scalar b) const
{
    return grown(a) != grown(b) || displacement(a) != displacement(b) ||
           (a < until_) != (b < until_);
}


void Foam::solidsBlock::add(
    const fvMesh& mesh, const UList<boundBox>& boxes, const scalar t,
    solidsFields& sums) const
{
    const scalar phi = grown(t) * solidity_;
    const vector moved(displacement(t));
    const bool rests = t >= until_;
    const vectorField& centres = mesh.C().primitiveField();
    forAll(centres, celli)
    {
        const scalar share =
            needsBoxes()
                ? shape_->over(boundBox(
                      boxes[celli].min() - moved, boxes[celli].max() - moved))
                : shape_->at(centres[celli] - moved);
        if (share > 0)
        {
            const vector u(velocity_ + (omega_ ^ (centres[celli] - origin_)));
            sums.add(
                celli, share * phi, rests ? vector::zero : u, diameter_,
                diameter_);
        }
    }
}


Foam::string Foam::solidsBlock::description() const
{
    readableText text;
    text << "uniform bed of solidity " << solidity_ << ", velocity "
         << velocity_ << " m/s";
    if (mag(omega_) > 0)
    {
        text << " turning by " << omega_ << " rad/s about " << origin_;
    }
    text << ", diameter " << diameter_ << " m " << shape_->description().c_str()
         << (moves_ ? " at first" : "");
    return text.str();
}


// ************************************************************************* //
