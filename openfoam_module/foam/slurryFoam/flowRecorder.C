/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowRecorder.H"
#include "flowTimes.H"
#include "foamVersion.H"
#include "IOdictionary.H"
#include "meshRotation.H"
#include "optionalDictionary.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "timeStep.H"
#include "untrapped.H"
#include "openfoam_module/record/rotation.hpp"

#include <sys/resource.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Add what is known of the case and the program
static void complete(millfoam::record::FlowSetup& setup, const Time& time)
{
    setup.solver = "slurryFoam";
    setup.openfoam_version = std::to_string(foamVersion::api);
    setup.openfoam_patch = foamVersion::patch;
    setup.openfoam_build = foamVersion::build;
    setup.ranks = Pstream::nProcs();
    setup.begin = time.value();
    if (const std::optional<scalar> end = askedEnd(time))
    {
        setup.asked_end = *end;
    }
    setup.angular_velocity = meshRotation(time);
    setup.limits = timeStep::limits(time.controlDict());

    const IOdictionary mill(optionalDictionary("millProperties", time, false));
    setup.mill_charge = mill.lookupOrDefault<string>("chargeFingerprint", "");
    setup.mill_averages =
        mill.lookupOrDefault<string>("averagesFingerprint", "");
    setup.mill_flow = mill.lookupOrDefault<string>("flowFingerprint", "");
}

//- Sum of the largest resident memory of each rank, bytes. Call it on all ranks
static scalar usedMemory()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return returnReduce(1024.0 * scalar(usage.ru_maxrss), sumOp<scalar>());
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::flowRecorder::onMaster(const std::function<void()>& action) const
{
    if (!Pstream::master())
    {
        return;
    }
    const auto failure = untrapped(action);
    if (failure)
    {
        FatalErrorInFunction << failure->c_str() << exit(FatalError);
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::flowRecorder::flowRecorder(
    const Time& time, millfoam::record::FlowSetup setup)
: time_(time),
  record_()
{
    complete(setup, time);
    Info << "Mesh: "
         << millfoam::record::described_rotation(setup.angular_velocity).c_str()
         << ", omega " << setup.angular_velocity << " rad/s about z" << nl
         << endl;
    onMaster(
        [&]
        {
            record_ = std::make_unique<millfoam::record::FlowRecord>(
                std::string(time.globalPath()), time.timeName(), setup);
        });
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::flowRecorder::isComplete(const Time& time)
{
    const bool result =
        Pstream::master() && millfoam::record::is_complete(
                                 std::string(time.globalPath()), time.value());
    return returnReduce(result, orOp<bool>());
}


void Foam::flowRecorder::add(
    millfoam::record::StepRow row, const courantNumbers& courant)
{
    row.courant = courant.flow;
    row.surface_courant = courant.surface;
    row.air_courant = courant.air;
    row.voidage_change = courant.voidageChange;
    const scalar memory = time_.writeTime() ? usedMemory() : 0;
    onMaster(
        [&]
        {
            record_->add(row);
            if (time_.writeTime())
            {
                record_->set_memory(memory);
                record_->write(false);
            }
        });
}


void Foam::flowRecorder::setStages(const millfoam::record::StageClock& clock)
{
    onMaster([&] { record_->set_stages(clock.times()); });
}


void Foam::flowRecorder::end()
{
    const scalar memory = usedMemory();
    onMaster(
        [&]
        {
            record_->set_memory(memory);
            record_->write(hasReachedAskedEnd(time_));
        });
}


// ************************************************************************* //
