/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Application
    slurryStart

Description
    Slurry at the start of a flow: sets alpha.slurry at the start time, with a
    surface that is flat to round-off on every mesh.

    - pool: all below a level, or as high as a volume of slurry reaches between
      the balls
    - above: a volume of slurry as a layer on top of the highest balls
    - feed: none; it comes with the feed

    A case in which a flow has begun, with times after the first, is refused.

    The level is a height above the origin of the mesh, opposite to gravity. The
    balls of constant/bedProperties, if there are any, take their room.

Usage
    system/slurryStartDict:
    \verbatim
        start           pool;       // or above, feed
        volume          2.9e-5;     // m3; of a pool or a layer above
        level           -0.02;      // m; of a pool, instead of its volume
        phase           slurry;     // optional
        bedShare        0.05;       // optional: solidity that counts as balls
    \endverbatim

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "caseKeeper.H"
#include "caseTimes.H"
#include "Enum.H"
#include "fvMesh.H"
#include "heightCut.H"
#include "knownEntries.H"
#include "movingBed.H"
#include "optionalDictionary.H"
#include "readableLog.H"
#include "surfaceFields.H"
#include "Time.H"
#include "uniformDimensionedFields.H"
#include "openfoam_module/record/tool_help.hpp"

#include <iostream>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

enum class start
{
    pool,
    above,
    feed
};

const Enum<start> startNames({
    {start::pool, "pool"},
    {start::above, "above"},
    {start::feed, "feed"},
});


//- Refuse an entry that this start does not use
void refuseUnused(const dictionary& dict, const word& key)
{
    if (dict.found(key))
    {
        FatalIOErrorInFunction(dict)
            << "start is " << dict.get<word>("start") << ", which has no "
            << key << "; expected no entry '" << key << "', or start pool"
            << exit(FatalIOError);
    }
}


//- The levels between which slurry starts
Pair<scalar> levels(
    const dictionary& dict, const heightCut& cut, const scalarField& solidity)
{
    refuseMisspelt(dict, {"start", "level", "volume", "bedShare", "phase"});
    const start kind = startNames.get("start", dict);
    if (kind == start::feed)
    {
        refuseUnused(dict, "level");
        refuseUnused(dict, "volume");
        return {cut.bottom(), cut.bottom()};
    }
    if (kind == start::above)
    {
        const scalar volume = dict.get<scalar>("volume");
        refuseUnused(dict, "level");
        const scalar bedShare = dict.lookupOrDefault<scalar>("bedShare", 0.05);
        const scalar densest = gMax(solidity);
        if (!(bedShare >= 0 && bedShare < densest))
        {
            FatalIOErrorInFunction(dict)
                << "bedShare is " << bedShare << "; expected a solidity from 0"
                << " to below the largest, " << densest << ", because the"
                << " layer lies on top of balls" << exit(FatalIOError);
        }
        const scalar from = cut.topOfBed(solidity, bedShare);
        return {from, cut.levelOf(volume, from, dict)};
    }
    if (dict.found("level") == dict.found("volume"))
    {
        FatalIOErrorInFunction(dict)
            << "expected one of the entries 'level' (m) and 'volume' (m3) of"
            << " the pool" << exit(FatalIOError);
    }
    if (!dict.found("level"))
    {
        return {
            cut.bottom(),
            cut.levelOf(dict.get<scalar>("volume"), cut.bottom(), dict)};
    }
    const scalar level = dict.get<scalar>("level");
    if (!(level > cut.bottom() && level < cut.top()))
    {
        FatalIOErrorInFunction(dict)
            << "level is " << level << " m; expected a height inside the mesh,"
            << " between " << cut.bottom() << " and " << cut.top() << " m"
            << exit(FatalIOError);
    }
    return {cut.bottom(), level};
}


//- Times after the first, of a case and of its ranks where it is decomposed
wordList laterTimes(const Time& time)
{
    fileNameList folders(rankFolders(time.path()));
    folders.append(time.path());
    wordList names;
    for (const fileName& folder : folders)
    {
        const instantList found(timesIn(folder));
        for (label i = 1; i < found.size(); ++i)
        {
            names.append(found[i].name());
        }
    }
    return names;
}


//- Refuse a case in which a flow has begun: its slurry would be overwritten
void refuseBegunFlow(const Time& time)
{
    const wordList later(laterTimes(time));
    if (!later.empty())
    {
        FatalErrorInFunction
            << time.path() << ": a flow has begun, there are " << later.size()
            << " written times, from " << later.first() << " to "
            << later.last() << " s, whose slurry would be overwritten or no"
            << " longer fit its start; expected only the first time. Remove"
            << " the times or run Allclean" << exit(FatalError);
    }
}


//- Upward unit vector, opposite to gravity
vector upwards(const fvMesh& mesh)
{
    const uniformDimensionedVectorField g(IOobject(
        "g", mesh.time().constant(), mesh, IOobject::MUST_READ,
        IOobject::NO_WRITE));
    if (!(mag(g.value()) > 0))
    {
        FatalErrorInFunction << "constant/g is " << g.value()
                             << "; expected gravity, which says"
                             << " where below is" << exit(FatalError);
    }
    return -g.value() / mag(g.value());
}


//- Set the share of slurry between two levels, with its patches, and write it
void writeSlurry(
    const word& phase, const heightCut& cut, const Pair<scalar>& range,
    const fvMesh& mesh)
{
    const word time(mesh.time().timeName());
    volScalarField alpha(
        IOobject(
            "alpha." + phase, time, mesh, IOobject::MUST_READ,
            IOobject::AUTO_WRITE),
        mesh);
    forAll(alpha, celli)
    {
        alpha[celli] =
            cut.share(celli, range.second()) - cut.share(celli, range.first());
    }
    // Open patches look the flux up, and there is no flow yet
    const surfaceScalarField phi(
        IOobject("phi", time, mesh), mesh,
        dimensionedScalar(dimVolume / dimTime, Zero));
    alpha.correctBoundaryConditions();
    alpha.write();
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

using namespace Foam;

static const millfoam::record::ToolHelp help{
    "slurryStart",
    "Slurry at the start of a flow: pool, layer or none",
    {"[-case DIR]"},
    {"system/slurryStartDict     what to start with",
     "constant/bedProperties     balls, which take their room; without it "
     "there are none",
     "constant/polyMesh, constant/g, system/controlDict",
     "0/alpha.slurry             its boundary conditions"},
    {"0/alpha.slurry             share of slurry in the fluid"}};


int main(int argc, char* argv[])
{
    if (millfoam::record::printed_help_or_version(argc, argv, help, std::cout))
    {
        return 0;
    }
    argList::addNote(help.purpose.c_str());

#include "setRootCase.H"
#include "createTime.H"
    readableLog();
    const caseKeeper keeper(runTime, help.name);
    refuseBegunFlow(runTime);

    const fvMesh mesh(IOobject(
        fvMesh::defaultRegion, runTime.timeName(), runTime,
        IOobject::MUST_READ));

    const IOdictionary dict(IOobject(
        "slurryStartDict", runTime.system(), mesh, IOobject::MUST_READ,
        IOobject::NO_WRITE));
    IOdictionary bedDict(optionalDictionary("bedProperties", mesh));
    // Balls that will move with the flow are not there yet
    bedDict.remove("exchange");
    const movingBed bed(bedDict, mesh);

    const heightCut cut(mesh, upwards(mesh), bed.voidage().primitiveField());
    const Pair<scalar> range(
        levels(dict, cut, bed.solidity().primitiveField()));
    writeSlurry(
        dict.lookupOrDefault<word>("phase", "slurry"), cut, range, mesh);

    Info << "Slurry from " << range.first() << " m to " << range.second()
         << " m: " << cut.volume(range.first(), range.second()) << " m3"
         << endl;
    return 0;
}


// ************************************************************************* //
