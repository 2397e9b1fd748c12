/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsSource.H"
#include "labelList.H"
#include "solidsBlocks.H"
#include "solidsExchange.H"
#include "solidsRecord.H"

// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::solidsSource>
Foam::solidsSource::New(const dictionary& dict, const fvMesh& mesh)
{
    const bool record = dict.found("solids");
    const bool blocks = dict.isDict("block") || dict.isDict("blocks");
    if (record && blocks)
    {
        FatalIOErrorInFunction(dict)
            << "both of the entries 'solids' (the name of a solids.h5) and"
            << " 'block' or 'blocks' (uniform beds) are there; expected one of"
            << " them" << exit(FatalIOError);
    }

    if (dict.isDict("block") && dict.isDict("blocks"))
    {
        FatalIOErrorInFunction(dict)
            << "both of the entries 'block' and 'blocks' are there; expected"
            << " one of them" << exit(FatalIOError);
    }

    if (dict.found("exchange"))
    {
        return autoPtr<solidsSource>(new solidsExchange(dict, mesh));
    }
    if (record)
    {
        return autoPtr<solidsSource>(new solidsRecord(dict, mesh));
    }
    if (blocks)
    {
        return autoPtr<solidsSource>(new solidsBlocks(dict));
    }
    return autoPtr<solidsSource>();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::labelList& Foam::solidsSource::uncovered() const
{
    return labelList::null();
}


millfoam::record::Solids Foam::solidsSource::forRecord() const
{
    millfoam::record::Solids result;
    result.source = description();
    return result;
}


Foam::scalar Foam::solidsSource::largestSolidity(const dictionary& dict)
{
    const scalar largest = dict.lookupOrDefault<scalar>("largestSolidity", 0.9);
    if (!(largest > 0 && largest < 1))
    {
        FatalIOErrorInFunction(dict)
            << "largestSolidity is " << largest
            << "; expected a number above 0 and below 1" << exit(FatalIOError);
    }
    return largest;
}


// ************************************************************************* //
