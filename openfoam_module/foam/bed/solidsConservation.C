/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsConservation.H"
#include "solidsSource.H"
#include "readableLog.H"
#include "PstreamReduceOps.H"
#include "vector2D.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Relative error of the corrected volume
static constexpr scalar precision = 1e-13;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::solidsConservation::volumes Foam::solidsConservation::bounded(
    const scalarField& solidity, const scalarField& V,
    const scalar factor) const
{
    vector2D sums(Zero);
    forAll(solidity, celli)
    {
        const scalar wanted = factor * solidity[celli];
        const bool below = wanted < largestSolidity_;
        sums.x() += min(wanted, largestSolidity_) * V[celli];
        sums.y() += below ? wanted * V[celli] : 0;
    }
    reduce(sums, sumOp<vector2D>());
    return {sums.x(), sums.y()};
}


Foam::scalar Foam::solidsConservation::factorFor(
    const scalarField& solidity, const scalarField& V, const scalar found,
    const scalar volume) const
{
    // The bounded volume is at most factor*found, so this starts below
    scalar factor = volume / found;
    while (true)
    {
        const volumes now = bounded(solidity, V, factor);
        const scalar missing = volume - now.all;
        if (mag(missing) <= precision * volume)
            return factor;

        if (!(now.belowBound > 0))
        {
            FatalIOErrorInFunction(dict_)
                << "the cells with solids have no room for the " << volume
                << " m3 of the ledger: filled to largestSolidity "
                << largestSolidity_ << " they hold " << now.all
                << " m3; expected a grid of solids that fits the mesh, or"
                << " ledgerCorrection no" << exit(FatalIOError);
        }
        const scalar better = factor * (1 + missing / now.belowBound);
        if (mag(better - factor) <= SMALL * factor)
            return better;
        factor = better;
    }
}


void Foam::solidsConservation::checkSize(
    const scalar found, const scalar volume,
    const std::function<string()>& advice) const
{
    if (mag(volume - found) <= largestCorrection_ * found)
        return;

    OStringStream percent;
    percent.precision(3);
    percent << 100 * (volume / max(found, VSMALL) - 1) << " %, in size above "
            << 100 * largestCorrection_ << " %";
    FatalIOErrorInFunction(dict_)
        << "the solids fill " << found << " m3 of the mesh but the ledger says "
        << volume << " m3: the correction would be " << percent.str().c_str()
        << ". " << advice().c_str()
        << "Check that the grid of the solids covers the mesh, that millAverage"
        << " had the walls (--inside) and that the mesh is turned to the "
           "solids'"
        << " time. largestCorrection allows a larger correction;"
        << " ledgerCorrection no is for a mesh that holds a part of the charge"
        << exit(FatalIOError);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsConservation::solidsConservation(const dictionary& dict)
: dict_(dict),
  largestSolidity_(solidsSource::largestSolidity(dict)),
  largestCorrection_(dict.lookupOrDefault<scalar>("largestCorrection", 0.02)),
  solids_(0),
  present_(0),
  largest_(0),
  moved_(0)
{
    if (!(largestCorrection_ >= 0 && largestCorrection_ <= 1))
    {
        FatalIOErrorInFunction(dict)
            << "largestCorrection is " << largestCorrection_
            << "; expected a share of the volume from 0 to 1"
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::solidsConservation::correct(
    scalarField& solidity, const scalarField& V, const scalar volume,
    const std::function<string()>& advice)
{
    vector2D sums(sum(solidity * V), sum(V));
    reduce(sums, sumOp<vector2D>());
    const scalar found = sums.x();
    solids_ = volume;
    // Of a bed that begins to grow both are round-off
    if (max(found, volume) <= precision * sums.y())
    {
        present_ = 0;
        moved_ = 0;
        return;
    }
    checkSize(found, volume, advice);

    const scalar factor = factorFor(solidity, V, found, volume);
    solidity = min(factor * solidity, largestSolidity_);

    present_ = volume / found - 1;
    largest_ = mag(present_) > mag(largest_) ? present_ : largest_;
    // What is left of it by the bound is round-off
    moved_ = factor * found - volume;
}


Foam::string Foam::solidsConservation::description() const
{
    readableText text;
    text << "volume corrected by " << 100 * present_ << " %, at most "
         << 100 * largest_ << " %, to " << solids_ << " m3";
    if (moved_ > 1e-9 * solids_)
    {
        text << ", " << moved_ << " m3 moved from cells above solidity "
             << largestSolidity_;
    }
    return text.str();
}


// ************************************************************************* //
