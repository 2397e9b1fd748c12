/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsRecord.H"
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


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using millfoam::averaging::CylinderGrid;
using millfoam::averaging::LocalSolids;
using millfoam::averaging::MeshCells;

//- Samples a window at a point of whatever grid a file has
struct pointSampler
{
    const millfoam::averaging::SolidsWindow& window;
    const point& p;
    millfoam::averaging::Interpolation interpolation;

    //- DEM time, s
    scalar time;

    template <class Grid> LocalSolids operator()(const Grid& grid) const
    {
        return millfoam::averaging::sample(
            grid, window, {p.x(), p.y(), p.z()}, interpolation);
    }

    //- A cylinder may turn
    LocalSolids operator()(const CylinderGrid& grid) const
    {
        return millfoam::averaging::sample(
            grid, window, {p.x(), p.y(), p.z()}, interpolation, time);
    }

    //- Fields on cells are not looked up by points
    LocalSolids operator()(const MeshCells&) const
    {
        return LocalSolids();
    }
};

//- Lengths of a grid's voxels, m; of a cylinder's at half of its radius
struct voxelLengths
{
    vector operator()(const millfoam::averaging::BoxGrid& grid) const
    {
        const auto lengths = grid.spacing();
        return vector(lengths[0], lengths[1], lengths[2]);
    }

    vector operator()(const CylinderGrid& grid) const
    {
        const auto lengths = grid.spacing();
        return vector(lengths[0], lengths[1] * grid.radii()[1] / 2, lengths[2]);
    }

    vector operator()(const MeshCells&) const
    {
        return vector::zero;
    }
};

} // End namespace Foam


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


void Foam::solidsRecord::checkMill() const
{
    const millfoam::averaging::SolidsHeader& header = reader_->header();

    const std::optional<double> known =
        turning() ? turning() : header.angular_velocity;
    scalar omega = 0;
    if (dict_.readIfPresent("omega", omega) && known)
    {
        const scalar recorded = *known;
        if (mag(omega - recorded) > 1e-6 * max(mag(omega), mag(recorded)))
        {
            FatalIOErrorInFunction(dict_)
                << "omega is " << omega << " rad/s but the mill of " << file_
                << " turned with " << recorded << " rad/s; expected the solids"
                << " of this speed. Run millDem and millAverage again, or make"
                << " the flow's mesh with the speed of the solids"
                << exit(FatalIOError);
        }
    }

    string fingerprint;
    if (dict_.readIfPresent("fingerprint", fingerprint) &&
        !fingerprint.empty() && !header.mill_averages.empty() &&
        fingerprint != header.mill_averages)
    {
        FatalIOErrorInFunction(dict_)
            << "fingerprint is " << fingerprint.c_str() << " but " << file_
            << " was averaged for the mill with the fingerprint "
            << header.mill_averages.c_str() << "; expected the solids of this"
            << " mill. Run millAverage again, and before it millDem if its"
            << " dumps are of another mill too" << exit(FatalIOError);
    }
}


void Foam::solidsRecord::checkMeshTime(const MeshCells& cells) const
{
    if (!cells.motion.empty() &&
        mag(cells.time - reader_->time0()) > reader_->timestep())
    {
        WarningInFunction
            << file_ << ": the mesh " << cells.file.c_str()
            << " holds for DEM time " << scalar(cells.time)
            << " s but the solids begin at " << reader_->time0()
            << " s, which is flow time 0: the flow's mesh is not where the"
            << " solids' was. Make the mesh with millMesh --at-time "
            << reader_->time0() << " or average from --start "
            << scalar(cells.time) << endl;
    }
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


std::optional<double> Foam::solidsRecord::turning() const
{
    const auto* cylinder = std::get_if<CylinderGrid>(&reader_->grid());
    return cylinder ? cylinder->frame().angular_velocity : std::nullopt;
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
        const LocalSolids local = std::visit(
            pointSampler{
                one.window, centres[i], interpolation_,
                reader_->time0() + time},
            reader_->grid());
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
    checkMill();
    clock_.reset(new solidsClock(dict, file_, *reader_));
    clock_->checkSpan(mesh.time());
    readLedger();

    if (const auto* cells = std::get_if<MeshCells>(&reader_->grid()))
    {
        cells_.reset(new solidsCells(dict, file_, mesh, *cells));
        checkMeshTime(*cells);
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
    const bool turned = turning() && time != sampledTime_;
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
    return std::visit(voxelLengths(), reader_->grid());
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
