/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsSource.H"
#include "solidsBlock.H"
#include "solidsRecord.H"

// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::solidsSource>
Foam::solidsSource::New(const dictionary& dict, const fvMesh& mesh)
{
    const bool block = dict.isDict("block");
    if (block == dict.found("solids"))
    {
        FatalIOErrorInFunction(dict)
            << (block ? "both" : "neither") << " of the entries 'solids' (the"
            << " name of a solids.h5) and 'block' (a uniform bed) "
            << (block ? "are" : "is") << " there; expected one of them"
            << exit(FatalIOError);
    }

    if (block)
    {
        return autoPtr<solidsSource>(new solidsBlock(dict.subDict("block")));
    }
    return autoPtr<solidsSource>(new solidsRecord(dict, mesh));
}


// ************************************************************************* //
