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
#include "functionObjectList.H"
#include "slurryFlow.H"
#include "timeStep.H"

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

using namespace Foam;

int main(int argc, char* argv[])
{
    argList::addNote(
        "Slurry and air through the moving balls of a tumbling mill");

#include "addCheckCaseOptions.H"
#include "setRootCaseLists.H"
#include "createTime.H"
#include "createDynamicFvMesh.H"

    pimpleControl pimple(mesh);
    slurryFlow flow(mesh);
    timeStep step(runTime);

    Info << "Starting time loop\n" << endl;

    while (runTime.run())
    {
        step.adjust(flow.courantNumbers());
        ++runTime;
        Info << "Time = " << runTime.timeName() << nl << endl;

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
        flow.report();

        runTime.write();
        runTime.printExecutionTime(Info);
    }

    if (runTime.timeIndex() == runTime.startTimeIndex())
    {
        // Nothing was left: what a run that was killed at its end left undone
        functionObjectList objects(runTime);
        objects.start();
        objects.end();
    }

    flow.summary();
    Info << "End\n" << endl;
    return 0;
}


// ************************************************************************* //
