/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsExchange.H"
#include "ballForces.H"
#include "cellsOnVoxels.H"
#include "Pstream.H"
#include "UIPstream.H"
#include "UOPstream.H"
#include "readableLog.H"
#include "untrapped.H"
#include "volFields.H"
#include "averaging/fields/ball_reaction.hpp"
#include "averaging/grids/field_sampling.hpp"
#include "millfoam_version.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

using namespace millfoam::averaging;

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::solidsExchange::sleepUntilMaster()
{
    if (!Pstream::parRun())
        return;

    char sign = 0;
    if (Pstream::master())
    {
        for (label rank = 1; rank < Pstream::nProcs(); ++rank)
        {
            UOPstream::write(
                UPstream::commsTypes::scheduled, rank, &sign, sizeof(sign));
        }
        return;
    }
    const label request = UPstream::nRequests();
    UIPstream::read(
        UPstream::commsTypes::nonBlocking, UPstream::masterNo(), &sign,
        sizeof(sign));
    while (!UPstream::finishedRequest(request))
    {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    UPstream::resetRequests(request);
}


template <class Action>
void Foam::solidsExchange::onMaster(const Action& action) const
{
    std::optional<std::string> reason;
    if (Pstream::master())
    {
        reason = untrapped(action);
    }
    sleepUntilMaster();
    string text(reason ? reason->c_str() : "");
    Pstream::scatter(text);
    if (!text.empty())
    {
        FatalErrorInFunction << text.c_str() << exit(FatalError);
    }
}


void Foam::solidsExchange::spread(ExchangeMessage& message)
{
    string kind(message.kind), text(message.text);
    scalarList numbers(
        UList<scalar>(message.numbers.data(), label(message.numbers.size())));
    Pstream::scatter(kind);
    Pstream::scatter(text);
    Pstream::scatter(numbers);
    message = {kind, text, {numbers.begin(), numbers.end()}};
}


void Foam::solidsExchange::greet()
{
    ExchangeMessage answer;
    const bool sizes = dict_.subOrEmptyDict("drag").lookupOrDefault<bool>(
        "polydispersity", false);
    onMaster(
        [&]
        {
            pipes_ = std::make_unique<ExchangePipes>(
                std::string(folder_), ExchangeSide::flow);
            pipes_->send(pack(
                FlowOffer{sizes, mesh_.time().value(), millfoam::version()}));
            answer = pipes_->receive(BallsOffer::kind);
        });
    spread(answer);
    balls_ = std::make_unique<const BallsOffer>(unpack_balls_offer(answer));
}


void Foam::solidsExchange::checkBalls() const
{
    scalar omega = 0;
    if (dict_.readIfPresent("omega", omega) && balls_->angular_velocity &&
        mag(omega - *balls_->angular_velocity) > 1e-6 * mag(omega))
    {
        FatalIOErrorInFunction(dict_)
            << "omega is " << omega << " rad/s but the mill of the balls turns"
            << " with " << scalar(*balls_->angular_velocity) << " rad/s;"
            << " expected the same mill" << exit(FatalIOError);
    }
    string fingerprint;
    if (dict_.readIfPresent("fingerprint", fingerprint) &&
        !fingerprint.empty() && fingerprint != balls_->mill)
    {
        FatalIOErrorInFunction(dict_)
            << "fingerprint is " << fingerprint.c_str() << " but the balls are"
            << " of the mill with the fingerprint " << balls_->mill.c_str()
            << "; expected the same mill" << exit(FatalIOError);
    }
    scalar time0 = 0;
    if (dict_.readIfPresent("time0", time0) &&
        mag(time0 - balls_->time0) > 1e-6)
    {
        FatalIOErrorInFunction(dict_)
            << "time0 is " << time0 << " s but the balls begin at DEM time "
            << scalar(balls_->time0) << " s: the mesh would be at another angle"
            << " than their walls. Make the mesh with millMesh --at-time "
            << scalar(balls_->time0) << exit(FatalIOError);
    }
}


void Foam::solidsExchange::receive(const scalar time)
{
    ExchangeMessage message;
    onMaster([&] { message = pipes_->receive(SolidsAt::kind); });
    spread(message);

    // In place of the earlier one
    state& next = states_[states_[0].time < states_[1].time ? 0 : 1];
    next.time = time;
    next.sampled = false;
    const auto reason = untrapped(
        [&] { next.solids = unpack_solids(message, balls_->grid.size()); });
    if (reason)
    {
        FatalErrorInFunction << reason->c_str() << exit(FatalError);
    }
}


Eigen::Isometry3d Foam::solidsExchange::locate()
{
    if (samples_)
    {
        if (const std::optional<Eigen::Isometry3d> motion = motion_.place())
        {
            return *motion;
        }
    }
    const auto reason = untrapped(
        [&]
        {
            samples_ = std::make_unique<const CellSamples>(
                motion_.begin(), balls_->grid);
        });
    if (reason)
    {
        FatalErrorInFunction << reason->c_str() << exit(FatalError);
    }
    return Eigen::Isometry3d::Identity();
}


void Foam::solidsExchange::sampleState(state& one)
{
    DynamicList<label> beyond;
    const Eigen::Isometry3d place(locate());
    const vectorField& centres = mesh_.C().primitiveField();
    one.sums.clear(centres.size());
    forAll(centres, i)
    {
        bool within = true;
        samples_->for_points(
            std::size_t(i), place,
            [&](const Vector3& at, const scalar share)
            {
                within = within && balls_->grid.locate(at);
                const LocalSolids local = millfoam::averaging::sample(
                    balls_->grid, one.solids.fields, at, Interpolation::linear);
                const Vector3& u = local.velocity;
                one.sums.add(
                    i, share * local.solidity, vector(u[0], u[1], u[2]),
                    local.diameter, local.diameter43);
            });
        if (!within)
        {
            beyond.append(i);
        }
    }
    uncovered_.transfer(beyond);
    one.sampled = true;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsExchange::solidsExchange(const dictionary& dict, const fvMesh& mesh)
: dict_(dict),
  mesh_(mesh),
  folder_(dict.get<fileName>("exchange").expand()),
  torque_(0),
  present_(0),
  motion_(mesh)
{
    if (!folder_.isAbsolute())
    {
        folder_ = mesh.time().globalPath() / folder_;
    }
    Info << "Waiting for the balls in " << folder_ << endl;
    greet();
    checkBalls();
    receive(mesh.time().value());
}


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::solidsExchange::~solidsExchange()
{
    if (pipes_)
    {
        // Balls that have ended need not be told
        const auto reason = untrapped(
            [this] {
                pipes_->send({exchange_end, {}, {}});
            });
        if (reason)
        {
            Info << reason->c_str() << endl;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::solidsExchange::sample(
    const fvMesh&, const scalar time, const bool moved, solidsFields& sums)
{
    const scalar latest = max(states_[0].time, states_[1].time);
    if (time > latest)
    {
        onMaster(
            [&] {
                pipes_->send(pack(ForcesUntil{time, torque_, forces_}));
            });
        receive(time);
    }
    const std::size_t nearest =
        mag(states_[0].time - time) < mag(states_[1].time - time) ? 0 : 1;
    state& one = states_[nearest];
    if (moved)
    {
        states_[0].sampled = states_[1].sampled = false;
    }
    const bool changed = nearest != present_ || !one.sampled;
    if (!one.sampled)
    {
        sampleState(one);
    }
    present_ = nearest;
    if (changed)
    {
        sums = one.sums;
    }
    return changed;
}


void Foam::solidsExchange::tell(
    const ballForces& feel, const vectorField& U, const scalar torque)
{
    torque_ = torque;
    const SolidsWindow& window = states_[present_].solids.fields;
    const scalarField& sampled = states_[present_].sums.solidity();
    const scalarField& volumes = mesh_.V();
    const Eigen::Isometry3d place(locate());
    BallReaction reaction(balls_->grid.size());
    const auto vector3 = [](const vector& v) {
        return Vector3{v.x(), v.y(), v.z()};
    };
    forAll(volumes, celli)
    {
        if (!(feel.solidity[celli] > 0))
            continue;

        // The cell's volume, with the correction of its solids to the ledger's
        const scalar volume =
            volumes[celli] * feel.solidity[celli] / sampled[celli];
        samples_->for_points(
            std::size_t(celli), place,
            [&](const Vector3& at, const scalar share)
            {
                reaction.add(
                    solids_shares(balls_->grid, window, at), share * volume,
                    vector3(feel.pressure[celli]), feel.exchange[celli],
                    vector3(U[celli]));
            });
    }
    sumOnMaster(reaction.sums());
    if (Pstream::master())
    {
        forces_ = reaction.fields(balls_->grid, window);
    }
}


Foam::vector Foam::solidsExchange::spacing() const
{
    const auto lengths = balls_->grid.spacing();
    return vector(lengths[0], lengths[1], lengths[2]);
}


Foam::string Foam::solidsExchange::description() const
{
    readableText text;
    text << "balls that move at the same time and feel the flow, from DEM time "
         << scalar(balls_->time0) << " s";
    return text.str();
}


millfoam::record::Solids Foam::solidsExchange::forRecord() const
{
    millfoam::record::Solids result;
    result.source = description();
    result.begin = balls_->time0;
    result.end = balls_->time0 + mesh_.time().endTime().value();
    result.angular_velocity = balls_->angular_velocity;
    result.program = "millDem " + balls_->program;
    result.mill_averages = balls_->mill;
    return result;
}


// ************************************************************************* //
