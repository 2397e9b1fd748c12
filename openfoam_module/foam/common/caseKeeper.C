/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "caseKeeper.H"
#include "Pstream.H"
#include "Time.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::caseKeeper::caseKeeper(const Time& time, const std::string& program)
: lock_()
{
    if (!Pstream::master())
    {
        return;
    }
    const auto failure = untrapped(
        [&]
        {
            lock_.emplace(millfoam::record::lock_case(
                std::string(time.globalPath()), program));
        });
    if (failure)
    {
        FatalErrorInFunction << failure->c_str() << exit(FatalError);
    }
}


// ************************************************************************* //
