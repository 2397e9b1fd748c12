/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "writeEnd.H"
#include "addToRunTimeSelectionTable.H"
#include "knownEntries.H"
#include "Time.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(writeEnd, 0);
addToRunTimeSelectionTable(functionObject, writeEnd, dictionary);
} // End namespace functionObjects
} // End namespace Foam


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- A step may be longer than the Courant numbers allow by this share
static constexpr scalar longer_ = 0.01;

//- In steps: from here on two equal ones are left. After one that is not
//  shortened more than half of one is left, of which OpenFOAM still makes one
static constexpr scalar two_ = 1.6;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::writeEnd::writeEnd(
    const word& name, const Time& runTime, const dictionary& dict)
: timeFunctionObject(name, runTime)
{
    requireKnownEntries(
        dict, {"type", "libs", "functionObjectLibs", "region", "enabled", "log",
               "writeControl", "writeInterval", "executeControl",
               "executeInterval", "useUserTime", "errors"});
    read(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::writeEnd::execute()
{
    return true;
}


bool Foam::functionObjects::writeEnd::write()
{
    return true;
}


bool Foam::functionObjects::writeEnd::adjustTimeStep()
{
    const scalar left = time_.endTime().value() - time_.value();
    const scalar steps = left / time_.deltaTValue();
    if (steps > 0 && steps < two_)
    {
        const bool last = steps <= 1 + longer_;
        Time& time = const_cast<Time&>(time_);
        time.setDeltaT(last ? left : left / 2, false);
        if (last)
        {
            time.writeOnce();
        }
    }
    return true;
}


// ************************************************************************* //
