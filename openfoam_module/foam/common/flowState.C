/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowState.H"
#include "IOdictionary.H"
#include "PstreamReduceOps.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Whether a file of the state is a dictionary of numbers, in uniform
bool isNumbers(const word& name)
{
    return name == "slurryFlow" || name == "toldForces";
}


//- A file of the state at the present time
IOobject stateIO(const word& name, const fvMesh& mesh)
{
    return IOobject(
        name, mesh.time().timeName(), isNumbers(name) ? "uniform" : "", mesh,
        IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false);
}


bool isThere(const word& name, const fvMesh& mesh)
{
    IOobject io(stateIO(name, mesh));
    return isNumbers(name) ? io.typeHeaderOk<IOdictionary>(false)
                           : io.typeHeaderOk<volScalarField>(false);
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

bool Foam::resumesFlow(const fvMesh& mesh)
{
    bool found = mesh.time().startTimeIndex() > 0;
    for (const word name :
         {"forceAcceleration", "fluxDetail", "massMoved", "slurryFlow"})
    {
        // Not in a shorter way: each rank looks for each of them
        const bool present = isThere(name, mesh);
        found = found || present;
    }
    return returnReduce(found, orOp<bool>());
}


void Foam::requireState(const wordList& names, const fvMesh& mesh)
{
    if (!resumesFlow(mesh))
    {
        return;
    }
    for (const word& name : names)
    {
        if (!isThere(name, mesh))
        {
            FatalErrorInFunction
                << stateIO(name, mesh).objectPath() << ": no such file, but"
                << " the flow resumes at " << mesh.time().timeName()
                << " s; expected all files of this time. Remove the time if it"
                << " was not written to its end. To begin from its U, p_rgh"
                << " and alpha.slurry alone, remove its other files"
                << exit(FatalError);
        }
    }
}


// ************************************************************************* //
