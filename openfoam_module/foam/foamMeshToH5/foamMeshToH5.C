/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Application
    foamMeshToH5

Description
    Writes the mesh of a case to a mesh.h5, which millAverage reads.

    Any of OpenFOAM's formats is read: ASCII, binary, compressed. A decomposed
    mesh is put together from processor*, numbered as before it was decomposed,
    if there is no constant/polyMesh or with -decomposed.

Usage
    \b foamMeshToH5 [OPTION]

      - \par -o FILE
        The file to write; mesh.h5 of the case unless given

      - \par -times all|RANGES
        For a mesh whose points move: those of all times, or of ranges such as
        0.1:0.5,0.8, that have polyMesh/points; flow time 0 is that of constant.
        Without it only the points of constant are written. A mesh whose faces
        or cells change is refused

      - \par -time0 T
        DEM time, s, at flow time 0, where constant/millProperties has no
        \c time0; 0 unless given

      - \par -decomposed
        Take the mesh from processor* although there is a constant/polyMesh

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "meshAssembly.H"
#include "optionalDictionary.H"
#include "polyMesh.H"
#include "timeSelector.H"
#include "untrapped.H"
#include "averaging/mesh/mesh_file.hpp"
#include "openfoam_module/record/tool_help.hpp"

#include <iostream>

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

static const millfoam::record::ToolHelp help{
    "foamMeshToH5",
    "Write the mesh of a case to a mesh.h5 for millAverage",
    {"[-case DIR] [-o FILE] [-times all|RANGES] [-time0 T] [-decomposed]"},
    {"constant/polyMesh          the mesh, in any format, or "
     "processor*/constant/polyMesh",
     "TIME/polyMesh/points       its points at other times, with -times",
     "constant/millProperties    DEM time at flow time 0; optional"},
    {"mesh.h5                    or the FILE of -o"}};


static void addOptions()
{
    argList::addNote(help.purpose.c_str());
    argList::noParallel();
    argList::noFunctionObjects();
    argList::addOption("o", "file", "The file to write (default: mesh.h5)");
    argList::addOption(
        "times", "all|ranges",
        "Points of all times, or of ranges such as 0.1:0.5,0.8, that have"
        " polyMesh/points");
    argList::addOption("time0", "s", "DEM time at flow time 0 (default: 0)");
    argList::addBoolOption("decomposed", "Take the mesh from processor*");
}


//- Stop with what a file could not do
static void stopWith(const std::optional<std::string>& reason)
{
    if (reason)
    {
        FatalErrorInFunction << reason->c_str() << exit(FatalError);
    }
}


//- The time of the case or, by its name, of a processor's part
static autoPtr<Time> openTime(const argList& args, const word& part = "")
{
    return autoPtr<Time>::New(
        Time::controlDictName, args.rootPath(), args.caseName() / part,
        "system", "constant", false, false);
}


//- The case's mesh or, of a decomposed case, all its parts
static PtrList<meshPart> openParts(const argList& args, const Time& time)
{
    const fileName lists(time.path() / time.constant() / polyMesh::meshSubDir);
    const label n = fileHandler().nProcs(time.path());
    const bool whole = isDir(lists) && !args.found("decomposed");
    if (!whole && n == 0)
    {
        FatalErrorInFunction
            << time.path() << " has neither constant/polyMesh nor processor*"
            << " folders" << (args.found("decomposed") ? " (-decomposed)" : "")
            << "; expected a mesh" << exit(FatalError);
    }

    PtrList<meshPart> parts(whole ? 1 : n);
    forAll(parts, i)
    {
        const word part(whole ? word() : "processor" + Foam::name(i));
        parts.set(i, new meshPart(openTime(args, part), !whole));
    }
    return parts;
}


//- Number that an option gives
static scalar numberOf(const argList& args, const word& option)
{
    const std::string text(args[option]);
    char* end = nullptr;
    const scalar value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
    {
        FatalErrorInFunction << "-" << option << " is '" << text.c_str()
                             << "'; expected a finite number"
                             << exit(FatalError);
    }
    return value;
}


//- DEM time at flow time 0
static scalar findTime0(const argList& args, const Time& time)
{
    const IOdictionary mill(optionalDictionary("millProperties", time, false));

    scalar time0 = 0;
    const bool known = mill.readIfPresent("time0", time0);
    const scalar asked = args.found("time0") ? numberOf(args, "time0") : time0;
    if (known && asked != time0)
    {
        FatalErrorInFunction
            << "-time0 is " << asked << " s but " << mill.objectPath()
            << " says that the mesh was made for time0 " << time0
            << " s; expected the same, or no -time0" << exit(FatalError);
    }
    return asked;
}


//- The times whose points are to be written
static instantList chooseTimes(const argList& args, const meshAssembly& mesh)
{
    instantList times(mesh.times());
    if (!args.found("times"))
    {
        const instant constant(0, "constant");
        label others = 0;
        for (const instant& time : times)
        {
            mesh.checkTopology(time);
            others += time.value() == 0 ? 0 : 1;
        }
        if (others > 0)
        {
            Info << "The points are those of " << constant.name() << ", not of "
                 << others << " later times that have polyMesh/points"
                 << " (-times)" << endl;
        }
        return instantList(1, constant);
    }

    const string ranges(args["times"]);
    if (ranges != "all")
    {
        timeSelector(ranges).inplaceSelect(times);
    }
    if (times.empty())
    {
        FatalErrorInFunction << "-times " << ranges.c_str()
                             << " selects none of the times that have"
                             << " polyMesh/points: " << mesh.times()
                             << exit(FatalError);
    }
    for (const instant& time : times)
    {
        mesh.checkTopology(time);
    }
    return times;
}


// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

int main(int argc, char* argv[])
{
    if (millfoam::record::printed_help_or_version(argc, argv, help, std::cout))
    {
        return 0;
    }
    addOptions();
    argList args(argc, argv);
    const autoPtr<Time> time(openTime(args));
    const scalar time0 = findTime0(args, *time);
    const fileName file(
        args.lookupOrDefault<fileName>("o", time->path() / "mesh.h5"));
    stopWith(untrapped(
        [&]() { millfoam::averaging::require_mesh_or_nothing(file.c_str()); }));

    const meshAssembly mesh(openParts(args, *time));
    const instantList times(chooseTimes(args, mesh));

    const auto topology = mesh.topology();
    stopWith(untrapped(
        [&]()
        {
            millfoam::averaging::MeshWriter writer(
                std::string(file), topology, time0);
            for (const instant& t : times)
            {
                writer.append(t.value(), mesh.points(t));
            }
            writer.finish();
        }));

    Info << file << ": " << label(topology.cells) << " cells, "
         << label(topology.faces()) << " faces, " << label(topology.points)
         << " points at " << times.size()
         << (times.size() == 1 ? " time" : " times") << ", DEM time " << time0
         << " s at flow time 0" << endl;
    return 0;
}


// ************************************************************************* //
