/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsRecord.H"
#include "solidsGrid.H"
#include "solidsMill.H"
#include "untrapped.H"
#include "volFields.H"

#include <algorithm>
#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<millfoam::averaging::Interpolation>
    Foam::solidsRecord::interpolationNames_({
        {millfoam::averaging::Interpolation::cell, "cell"},
        {millfoam::averaging::Interpolation::linear, "linear"},
    });


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

template <class Read> void Foam::solidsRecord::reading(const Read& read) const
{
    if (const auto failure = untrapped(read))
    {
        FatalIOErrorInFunction(dict_) << *failure << exit(FatalIOError);
    }
}


void Foam::solidsRecord::open(const Time& time)
{
    if (!file_.isAbsolute())
    {
        file_ = time.globalPath() / file_;
    }

    reading(
        [this]()
        {
            reader_ = std::make_unique<millfoam::averaging::SolidsReader>(
                std::string(file_));
        });
}


void Foam::solidsRecord::readInterpolation()
{
    using millfoam::averaging::Interpolation;

    if (!cells_.valid())
    {
        interpolation_ = interpolationNames_.get("interpolation", dict_);
        return;
    }

    interpolation_ = interpolationNames_.getOrDefault(
        "interpolation", dict_, Interpolation::cell);
    if (interpolation_ != Interpolation::cell)
    {
        FatalIOErrorInFunction(dict_)
            << "interpolation is " << interpolationNames_[interpolation_]
            << " but " << file_ << " holds solids on the cells of the mesh;"
            << " expected cell, or no such entry" << exit(FatalIOError);
    }
}


void Foam::solidsRecord::readLedger()
{
    std::vector<millfoam::averaging::Ledger> ledgers;
    reading([&]() { ledgers = reader_->read_ledgers(); });
    for (const auto& ledger : ledgers)
    {
        if (!(std::isfinite(ledger.deposited) && ledger.deposited >= 0))
        {
            FatalIOErrorInFunction(dict_)
                << file_ << ": /ledger/deposited is "
                << scalar(ledger.deposited) << " in window "
                << label(deposited_.size()) << "; expected a volume, m3"
                << exit(FatalIOError);
        }
        deposited_.push_back(ledger.deposited);
    }
}


void Foam::solidsRecord::makeSpline(
    const millfoam::averaging::TimeSpline& spline)
{
    solidity_.resize(spline.size());
    for (std::size_t i = 0; i < spline.size(); ++i)
    {
        reading([&]() { solidity_[i] = reader_->read_window(i).solidity; });
    }
    const scalar largest = largestSolidity(dict_);
    std::vector<double> means(spline.size());
    for (std::size_t cell = 0; cell < solidity_.front().size(); ++cell)
    {
        for (std::size_t i = 0; i < spline.size(); ++i)
        {
            means[i] = solidity_[i][cell];
        }
        if (*std::max_element(means.begin(), means.end()) > 0)
        {
            const auto coefficients = spline.coefficients(means, largest);
            for (std::size_t i = 0; i < spline.size(); ++i)
            {
                solidity_[i][cell] = coefficients[i];
            }
        }
    }
    deposited_ = spline.coefficients(deposited_, GREAT);
}


Foam::solidsRecord::held& Foam::solidsRecord::have(
    const std::size_t number, const solidsClock::moment& now)
{
    for (held& one : held_)
    {
        if (one.number == number)
            return one;
    }

    held& free = *std::find_if(
        held_.begin(), held_.end(),
        [&now](const held& one)
        {
            return std::find(
                       now.windows.begin(), now.windows.end(), one.number) ==
                   now.windows.end();
        });
    reading([&]() { free.window = reader_->read_window(number); });
    if (!solidity_.empty())
    {
        free.window.solidity = solidity_[number];
    }
    free.number = number;
    free.sampled = false;
    return free;
}


bool Foam::solidsRecord::sampleWindow(
    const fvMesh& mesh, const scalar time, held& one)
{
    if (one.sampled)
        return false;

    one.sampled = true;
    if (cells_.valid())
    {
        cells_->pick(one.window, one.sums);
        return true;
    }

    DynamicList<label> beyond;
    const vectorField& centres = mesh.C().primitiveField();
    one.sums.clear(centres.size());
    forAll(centres, i)
    {
        const millfoam::averaging::LocalSolids local = solidsAt(
            centres[i], reader_->grid(), one.window, interpolation_,
            reader_->time0() + time);
        const vector u(local.velocity[0], local.velocity[1], local.velocity[2]);
        one.sums.add(i, local.solidity, u, local.diameter, local.diameter43);
        if (!local.inside)
        {
            beyond.append(i);
        }
    }
    uncovered_.transfer(beyond);
    return true;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsRecord::solidsRecord(const dictionary& dict, const fvMesh& mesh)
: dict_(dict),
  file_(dict.get<fileName>("solids").expand()),
  interpolation_(),
  moment_(),
  sampledTime_(0)
{
    open(mesh.time());
    requireMill(dict, file_, *reader_);
    clock_.reset(new solidsClock(dict, file_, *reader_, mesh.time()));
    clock_->checkSpan();
    requireChargeInPlace(dict, file_, *reader_, clock_(), mesh);
    readLedger();

    if (const auto* cells =
            std::get_if<millfoam::averaging::MeshCells>(&reader_->grid()))
    {
        cells_.reset(new solidsCells(dict, file_, mesh, *cells));
        adviseMeshTime(file_, *reader_, *cells);
    }
    readInterpolation();
    if (clock_->spline())
    {
        makeSpline(*clock_->spline());
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::solidsRecord::sample(
    const fvMesh& mesh, const scalar time, const bool moved, solidsFields& sums)
{
    const bool turned = turning(reader_->grid()) && time != sampledTime_;
    sampledTime_ = time;
    if ((moved && inSpace()) || turned)
    {
        for (held& one : held_)
        {
            one.sampled = false;
        }
    }
    const solidsClock::moment now = clock_->at(time);
    bool changed =
        now.windows != moment_.windows || now.shares != moment_.shares;
    moment_ = now;

    std::array<const solidsFields*, 3> solids;
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        held& one = have(now.windows[i], now);
        changed = sampleWindow(mesh, time, one) || changed;
        solids[i] = &one.sums;
    }
    if (changed)
    {
        sums.blend(solids, now.shares);
    }
    return changed;
}


Foam::scalar Foam::solidsRecord::volume() const
{
    scalar sum = 0;
    for (std::size_t i = 0; i < moment_.windows.size(); ++i)
    {
        sum += moment_.shares[i] * deposited_[moment_.windows[i]];
    }
    return sum;
}


Foam::vector Foam::solidsRecord::spacing() const
{
    return voxelLengths(reader_->grid());
}


millfoam::record::Solids Foam::solidsRecord::forRecord() const
{
    millfoam::record::Solids result = clock_->forRecord();
    result.source = description();
    result.file = file_;
    const millfoam::averaging::SolidsHeader& header = reader_->header();
    result.whole_run = header.whole_run;
    result.angular_velocity = header.angular_velocity;
    result.program = header.program;
    result.mill_charge = header.mill_charge;
    result.mill_averages = header.mill_averages;
    return result;
}


Foam::string Foam::solidsRecord::description() const
{
    return clock_->description() + ", " +
           (cells_.valid()
                ? "on the mesh's cells"
                : interpolationNames_[interpolation_] + " interpolation");
}


// ************************************************************************* //
