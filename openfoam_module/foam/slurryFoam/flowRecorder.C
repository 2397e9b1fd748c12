/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowRecorder.H"
#include "foamVersion.H"
#include "IOdictionary.H"
#include "meshRotation.H"
#include "optionalDictionary.H"
#include "Pstream.H"
#include "timeStep.H"
#include "untrapped.H"
#include "openfoam_module/record/rotation.hpp"

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
    if (time.endTime().value() < GREAT)
    {
        setup.asked_end = time.endTime().value();
    }
    setup.angular_velocity = meshRotation(time);
    setup.limits = timeStep::limits(time.controlDict());

    const IOdictionary mill(optionalDictionary("millProperties", time, false));
    setup.mill_charge = mill.lookupOrDefault<string>("chargeFingerprint", "");
    setup.mill_averages =
        mill.lookupOrDefault<string>("averagesFingerprint", "");
    setup.mill_flow = mill.lookupOrDefault<string>("flowFingerprint", "");
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

void Foam::flowRecorder::add(
    millfoam::record::StepRow row, const FixedList<scalar, 4>& courant)
{
    row.courant = courant[0];
    row.surface_courant = courant[1];
    row.voidage_change = courant[2];
    onMaster(
        [&]
        {
            record_->add(row);
            if (time_.writeTime())
            {
                record_->write(false);
            }
        });
}


void Foam::flowRecorder::end()
{
    onMaster([this] { record_->write(true); });
}


// ************************************************************************* //
