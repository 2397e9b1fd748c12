/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Application
    slurryFoam

Description
    Slurry and air through the moving balls of a tumbling mill: volume-averaged
    equations with geometric transport of the slurry's surface, on static,
    rotating and deforming meshes. Equations: slurryFlow. Surface and gravity:
    slurrySurface. Balls: movingBed and bedDrag, from constant/bedProperties.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "caseKeeper.H"
#include "flowControls.H"
#include "flowFunctions.H"
#include "flowRecorder.H"
#include "flowTimes.H"
#include "meshSpeed.H"
#include "readableLog.H"
#include "slurryFlow.H"
#include "timeStep.H"
#include "openfoam_module/record/tool_help.hpp"

#include <iostream>

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

using namespace Foam;

static const millfoam::record::ToolHelp help{
    "slurryFoam",
    "Slurry and air through the moving balls of a tumbling mill",
    {"[-case DIR]",
     "-parallel [-case DIR]    (under mpirun, after decomposePar)"},
    {"0/                              fields at the start: U, p_rgh, "
     "alpha.slurry",
     "constant/polyMesh               mesh, of millMesh",
     "constant/dynamicMeshDict        how the mesh moves",
     "constant/transportProperties    slurry and air",
     "constant/g                      gravity",
     "constant/bedProperties          balls and their drag; without it there "
     "are none",
     "constant/grateProperties        grates; without it there are none",
     "constant/millProperties         fingerprints of the mill, of millMesh; "
     "optional",
     "exchange/                       pipes to balls that move at the same "
     "time, "
     "where bedProperties names it",
     "solids.h5                       the balls, of millAverage, where "
     "bedProperties names it",
     "system/                         controlDict, fvSchemes, fvSolution"},
    {"TIME/                           fields at the written times",
     "postProcessing/flow/TIME/       steps.csv: a row per time-step; "
     "flow.json: the summary",
     "postProcessing/, slurry.h5      what the function objects of controlDict "
     "measure"}};


int main(int argc, char* argv[])
{
    if (millfoam::record::printed_help_or_version(argc, argv, help, std::cout))
    {
        return 0;
    }
    argList::addNote(help.purpose.c_str());

#include "addCheckCaseOptions.H"
#include "setRootCaseLists.H"
    checkIntervals(args.globalPath());
#include "createTime.H"
    readableLog();
    const caseKeeper keeper(runTime, help.name);
    checkFlowTimes(runTime);
    checkMeshFiles(runTime);
#include "createDynamicFvMesh.H"

    checkFlowControls(mesh);
    pimpleControl pimple(mesh);
    millfoam::record::StageClock clock;
    slurryFlow flow(mesh, clock);
    checkMeshSpeed(mesh.lookupObject<volVectorField>("U"));
    timeStep step(runTime);
    millfoam::record::FlowSetup setup;
    flow.addTo(setup);
    if (hasEnded(runTime) && flowRecorder::isComplete(runTime))
    {
        endFunctionObjects(runTime);
        Info << "The flow has reached endTime: nothing is left to compute" << nl
             << "End" << nl << endl;
        return 0;
    }
    flowRecorder recorder(runTime, setup);
    courantNumbers courant(flow.bounds());

    flow.tellBalls();
    Info << "Starting time loop\n" << endl;

    while (runTime.run())
    {
        if (runTime.timeIndex() == runTime.startTimeIndex())
        {
            requireFunctionObjects(runTime);
        }
        clock.begin("output");
        step.adjust(courant);
        ++runTime;
        Info << "Time = " << runTime.timeName() << nl << endl;

        clock.begin("mesh");
        mesh.update();
        flow.enter();
        while (pimple.loop())
        {
            flow.predict(pimple);
            while (pimple.correct())
            {
                flow.project(pimple);
            }
        }
        flow.transport();
        flow.tellBalls();
        clock.begin("output");
        const millfoam::record::StepRow row(flow.report());
        courant = flow.bounds();

        // Before the fields: a restart from them must find the row
        recorder.setStages(clock);
        recorder.add(row, courant);
        runTime.write();
        runTime.printExecutionTime(Info);
    }

    if (runTime.timeIndex() == runTime.startTimeIndex())
    {
        endFunctionObjects(runTime);
    }

    flow.summary();
    recorder.setStages(clock);
    recorder.end();
    Info << "End\n" << endl;
    return 0;
}


// ************************************************************************* //
