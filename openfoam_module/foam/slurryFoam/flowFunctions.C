/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowFunctions.H"
#include "functionObjectList.H"
#include "Time.H"

// * * * * * * * * * * * * * * * * Local Data  * * * * * * * * * * * * * * * //

namespace Foam
{

//- Types that open a new table when they are made, and do nothing at the end
static const wordList
    tables_({"slurryBalance", "axialProfiles", "slurryTracer"});

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::requireFunctionObjects(const Time& time)
{
    const dictionary* functions = time.controlDict().findDict("functions");
    if (!functions || !time.functionObjects().status())
    {
        return;
    }
    for (const entry& one : *functions)
    {
        if (one.isDict() && one.dict().lookupOrDefault("enabled", true) &&
            time.functionObjects().findObjectID(one.keyword()) < 0)
        {
            FatalIOErrorInFunction(one.dict())
                << "type is "
                << one.dict().lookupOrDefault<word>("type", "none")
                << ", but the function object " << one.keyword()
                << " could not be made, for the reason in the warning above;"
                << " expected a type of OpenFOAM or millFoam, and its library "
                   "in"
                << " libs" << exit(FatalIOError);
        }
    }
}


void Foam::endFunctionObjects(const Time& time)
{
    dictionary control(time.controlDict());
    if (dictionary* functions = control.findDict("functions"))
    {
        for (const word& name : functions->toc())
        {
            const dictionary* one = functions->findDict(name);
            if (one &&
                tables_.found(one->lookupOrDefault<word>("type", "none")))
            {
                functions->remove(name);
            }
        }
    }
    functionObjectList objects(time, control);
    objects.start();
    objects.end();
}


// ************************************************************************* //
