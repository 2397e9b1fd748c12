/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowTimes.H"
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

//- The latest time in a folder; none where it has no times
std::optional<scalar> latestTime(const Time& time, const fileName& folder)
{
    if (!isDir(folder))
    {
        return std::nullopt;
    }
    const instantList found(Time::findTimes(folder, time.constant()));
    return found.empty() || found.last().name() == time.constant()
               ? std::nullopt
               : std::optional<scalar>(found.last().value());
}


//- Refuse to begin on one rank a flow that several have computed
void refuseResultsOfRanks(const Time& time)
{
    const std::optional<scalar> ranks =
        latestTime(time, time.path() / "processor0");
    const std::optional<scalar> whole = latestTime(time, time.path());
    if (!Pstream::parRun() && ranks && *ranks > whole.value_or(-GREAT))
    {
        FatalErrorInFunction
            << time.path() << ": a flow on several ranks has reached " << *ranks
            << " s in processor*, and the case itself has no time later than "
            << whole.value_or(0) << " s: the results would be replaced."
            << " Expected 'slurryFoam -parallel', which resumes the flow, or"
            << " 'reconstructPar -latestTime' before a flow on one rank. Remove"
            << " processor* or run Allclean to begin again" << exit(FatalError);
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
    refuseResultsOfRanks(time);
    refuseEarlierEnd(time);
}


bool Foam::hasEnded(const Time& time)
{
    return !(time.value() < time.endTime().value() - 0.5 * time.deltaTValue());
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
