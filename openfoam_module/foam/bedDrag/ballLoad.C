/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ballLoad.H"
#include "readableLog.H"
#include "weightedSpread.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ballLoad::ballLoad(
    const dictionary& dict, const movingBed& bed, const vector& g)
: bed_(bed),
  g_(g),
  density_(dict.get<scalar>("ballDensity")),
  ratio_(
      IOobject(
          "forceOverWeight", bed.solidity().time().timeName(),
          bed.solidity().mesh(), IOobject::NO_READ, IOobject::AUTO_WRITE),
      bed.solidity().mesh(), dimensionedScalar(dimless, Zero)),
  mean_(0),
  high_(0),
  meanSum_(0),
  highSum_(0),
  updates_(0)
{
    if (!(density_ > 0 && mag(g_) > 0))
    {
        FatalIOErrorInFunction(dict)
            << "ballDensity is " << density_ << " kg/m3 and gravity " << g_
            << " m/s2; expected a density above 0 and, for the balls' weight,"
            << " gravity. Without the entry the force on the balls is not "
               "reported"
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::ballLoad::update(
    const vectorField& pressureForce, const volScalarField::Internal& exchange,
    const volVectorField& U)
{
    forAll(ratio_, celli)
    {
        const scalar phi = bed_.solidity()[celli];
        ratio_[celli] = 0;
        if (phi > 0)
        {
            const vector force(
                phi * pressureForce[celli] +
                exchange[celli] * (U[celli] - bed_.velocity()[celli]));
            ratio_[celli] = mag(force) / (phi * density_ * mag(g_));
        }
    }
    const weightedSpread spread = spreadOf(
        ratio_.primitiveField(),
        bed_.solidity().primitiveField() * ratio_.mesh().V());
    mean_ = spread.mean;
    high_ = spread.high;
    meanSum_ += mean_;
    highSum_ += high_;
    ++updates_;
}


Foam::string Foam::ballLoad::description() const
{
    readableText text;
    text << "force of the fluid on the balls over their weight: mean " << mean_
         << ", 95 % below " << high_;
    return text.str();
}


Foam::string Foam::ballLoad::summary() const
{
    readableText text;
    text << "force of the fluid on the balls over their weight, in the mean of "
         << updates_ << " written times: mean "
         << (updates_ > 0 ? meanSum_ / updates_ : 0) << ", 95 % below "
         << (updates_ > 0 ? highSum_ / updates_ : 0);
    return text.str();
}


// ************************************************************************* //
