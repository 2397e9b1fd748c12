/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "knownEntries.H"
#include "ListOps.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Letters to change, add or take away between two words (Levenshtein)
label distance(const word& a, const word& b)
{
    labelList row(identity(label(b.size()) + 1));
    for (unsigned i = 0; i < a.size(); ++i)
    {
        label diagonal = row[0];
        row[0] = i + 1;
        for (unsigned j = 0; j < b.size(); ++j)
        {
            const label changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = min(changed, 1 + min(row[j], row[j + 1]));
        }
    }
    return row.last();
}


//- The known name that this nearly is, or an empty word
word nearest(const word& name, const wordList& known)
{
    for (const word& candidate : known)
    {
        const label allowed =
            max(label(1), min(label(2), label(candidate.size() / 4)));
        if (distance(name, candidate) <= allowed)
        {
            return candidate;
        }
    }
    return word::null;
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::requireKnownEntries(const dictionary& dict, const wordList& known)
{
    for (const entry& one : dict)
    {
        if (!known.found(one.keyword()))
        {
            FatalIOErrorInFunction(dict)
                << "unknown entry '" << one.keyword() << "'; expected one of";
            for (const word& name : known)
            {
                FatalIOError << ' ' << name;
            }
            FatalIOError << exit(FatalIOError);
        }
    }
}


void Foam::refuseMisspelt(const dictionary& dict, const wordList& known)
{
    for (const entry& one : dict)
    {
        const word& name = one.keyword();
        const word meant(known.found(name) ? word::null : nearest(name, known));
        if (!meant.empty())
        {
            FatalIOErrorInFunction(dict)
                << "unknown entry '" << name << "'; expected '" << meant
                << "'? Entries of your own for use in this file need another"
                << " name" << exit(FatalIOError);
        }
    }
}


void Foam::requireAboveZero(const dictionary& dict, const wordList& names)
{
    for (const word& name : names)
    {
        scalar value;
        if (dict.readIfPresent(name, value) && !(value > 0))
        {
            FatalIOErrorInFunction(dict)
                << name << " is " << value << "; expected a number above 0"
                << exit(FatalIOError);
        }
    }
}


// ************************************************************************* //
