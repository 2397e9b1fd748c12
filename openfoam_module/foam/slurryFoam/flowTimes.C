/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowTimes.H"
#include "caseTimes.H"
#include "HashSet.H"
#include "fileOperation.H"
#include "IFstream.H"
#include "knownEntries.H"
#include "OSspecific.H"
#include "polyMesh.H"
#include "Pstream.H"
#include "Time.H"

#include <optional>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- The latest time in folders; none where they have no times
std::optional<scalar> latestTime(const fileNameList& folders)
{
    std::optional<scalar> result;
    for (const fileName& folder : folders)
    {
        const instantList found(timesIn(folder));
        if (!found.empty())
        {
            result = max(result.value_or(-GREAT), found.last().value());
        }
    }
    return result;
}


//- Refuse to begin or resume where the results of the other kind, of several
//  ranks or of the case itself, are later: they would be replaced
void refuseLaterResults(const Time& time)
{
    const fileName folder(time.globalPath());
    const std::optional<scalar> ranks = latestTime(rankFolders(folder));
    const std::optional<scalar> whole = latestTime({folder});
    if (!Pstream::parRun() && ranks && *ranks > whole.value_or(-GREAT))
    {
        FatalErrorInFunction
            << folder << ": a flow on several ranks has reached " << *ranks
            << " s in processor*, and the case itself has no time later than "
            << whole.value_or(0) << " s: the results would be replaced."
            << " Expected 'slurryFoam -parallel', which resumes the flow, or"
            << " 'reconstructPar -latestTime' before a flow on one rank. Remove"
            << " processor* or run Allclean to begin again" << exit(FatalError);
    }
    if (Pstream::parRun() && whole && ranks && *whole > *ranks)
    {
        FatalErrorInFunction
            << folder << ": a flow on one rank has reached " << *whole
            << " s in the case itself, and processor* have no time later than "
            << *ranks << " s: the results would be replaced."
            << " Expected 'slurryFoam' on one rank, which resumes the flow, or"
            << " 'decomposePar -latestTime -force' before a flow on several"
            << " ranks. Remove the later times of the case to resume that of"
            << " processor*" << exit(FatalError);
    }
}


//- Refuse a flow that has passed its end
void refuseEarlierEnd(const Time& time)
{
    const scalar end = time.endTime().value();
    // A flow with a fixed time-step may end half of one beyond it
    if (time.value() > end + time.deltaTValue())
    {
        FatalIOErrorInFunction(time.controlDict())
            << "endTime is " << end << " s, but the flow has reached "
            << time.value() << " s; expected this time or a later one"
            << exit(FatalIOError);
    }
}

//- Whether this control of a function object divides a time by its interval
bool dividesByInterval(const dictionary& dict, const word& control)
{
    static const wordHashSet inTime(
        {"runTime", "adjustable", "adjustableRunTime", "cpuTime", "clockTime"});
    return inTime.found(dict.lookupOrDefault<word>(control, "none"));
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::checkIntervals(const fileName& folder)
{
    IFstream stream(folder / "system" / "controlDict");
    if (!Pstream::master() || !stream.good())
    {
        return;
    }
    const dictionary control(stream);
    requireAboveZero(control, {"deltaT", "writeInterval"});
    const dictionary functions(control.subOrEmptyDict("functions"));
    for (const entry& one : functions)
    {
        for (const word what : {"write", "execute"})
        {
            if (one.isDict() &&
                dividesByInterval(one.dict(), word(what + "Control")))
            {
                requireAboveZero(one.dict(), {word(what + "Interval")});
            }
        }
    }
}


void Foam::checkFlowTimes(const Time& time)
{
    if (Pstream::master())
    {
        refuseLaterResults(time);
    }
    refuseEarlierEnd(time);
}


bool Foam::hasEnded(const Time& time)
{
    return !(time.value() < time.endTime().value() - 0.5 * time.deltaTValue());
}


std::optional<Foam::scalar> Foam::askedEnd(const Time& time)
{
    scalar end = 0;
    return time.controlDict().readIfPresent("endTime", end)
               ? std::optional<scalar>(end)
               : std::nullopt;
}


bool Foam::hasReachedAskedEnd(const Time& time)
{
    const std::optional<scalar> end = askedEnd(time);
    return end && !(time.value() < *end - 0.5 * time.deltaTValue());
}


void Foam::checkMeshFiles(const Time& time)
{
    for (const word name :
         {"points", "faces", "owner", "neighbour", "boundary"})
    {
        const IOobject io(
            name,
            time.findInstance(
                polyMesh::meshSubDir, name == "points" ? name : word("faces"),
                IOobject::READ_IF_PRESENT),
            polyMesh::meshSubDir, time);
        if (fileHandler().filePath(false, io, word::null).empty())
        {
            FatalErrorInFunction
                << io.objectPath() << ": no such file; expected the mesh in"
                << " points, faces, owner, neighbour and boundary, which"
                << " millMesh writes"
                << (Pstream::parRun() ? ", and decomposePar for each rank" : "")
                << exit(FatalError);
        }
    }
}


// ************************************************************************* //
