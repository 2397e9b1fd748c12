/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "heightCut.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::heightCut::heightCut(
    const fvMesh& mesh, const vector& up, const scalarField& voidage)
: mesh_(mesh),
  cut_(mesh),
  up_(up),
  fluid_(voidage * mesh.V()),
  lowest_(mesh.nCells(), GREAT),
  highest_(mesh.nCells(), -GREAT)
{
    forAll(lowest_, celli)
    {
        for (const label pointi : mesh.cellPoints()[celli])
        {
            const scalar height = up & mesh.points()[pointi];
            lowest_[celli] = min(lowest_[celli], height);
            highest_[celli] = max(highest_[celli], height);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::heightCut::share(const label celli, const scalar level) const
{
    if (level <= lowest_[celli])
    {
        return 0;
    }
    if (level >= highest_[celli])
    {
        return 1;
    }
    return cut_.wetVolume(celli, up_, level) /
           cut_.wetVolume(celli, up_, highest_[celli] + 1);
}


Foam::scalar Foam::heightCut::volume(const scalar from, const scalar to) const
{
    scalar sum = 0;
    forAll(fluid_, celli)
    {
        sum += fluid_[celli] * (share(celli, to) - share(celli, from));
    }
    return returnReduce(sum, sumOp<scalar>());
}


Foam::scalar Foam::heightCut::bottom() const
{
    return gMin(lowest_);
}


Foam::scalar Foam::heightCut::top() const
{
    return gMax(highest_);
}


Foam::scalar Foam::heightCut::topOfBed(
    const scalarField& solidity, const scalar bedShare) const
{
    scalar top = -GREAT;
    forAll(solidity, celli)
    {
        if (solidity[celli] > bedShare)
        {
            top = max(top, highest_[celli]);
        }
    }
    return returnReduce(top, maxOp<scalar>());
}


Foam::scalar Foam::heightCut::levelOf(
    const scalar wanted, const scalar from, const dictionary& dict) const
{
    const scalar room = volume(from, top());
    if (!(wanted > 0 && wanted < room))
    {
        FatalIOErrorInFunction(dict)
            << "volume is " << wanted << " m3; expected above 0 and below"
            << " the " << room << " m3 of room between the heights " << from
            << " and " << top() << " m" << exit(FatalIOError);
    }
    scalar low = from;
    scalar high = top();
    while (high - low > 1e-15 * (mag(low) + mag(high)))
    {
        const scalar middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
        {
            break;
        }
        (volume(from, middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}


// ************************************************************************* //
