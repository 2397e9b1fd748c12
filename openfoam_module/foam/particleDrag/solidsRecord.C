/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsRecord.H"
#include "OStringStream.H"
#include "Time.H"

#include <cfenv>
#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::solidsRecord::range> Foam::solidsRecord::rangeNames_({
    {range::error, "error"},
    {range::hold, "hold"},
    {range::repeat, "repeat"},
});

const Foam::Enum<millfoam::averaging::Interpolation>
    Foam::solidsRecord::interpolationNames_({
        {millfoam::averaging::Interpolation::cell, "cell"},
        {millfoam::averaging::Interpolation::linear, "linear"},
    });


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::solidsRecord::guarded(const std::function<void()>& action) const
{
    // OpenFOAM traps invalid operations: a NaN in the file would stop the
    // program where it is first compared, before the reader can name it
    std::fenv_t traps;
    std::feholdexcept(&traps);

    bool failed = false;
    std::string reason;
    try
    {
        action();
    }
    catch (const std::exception& error)
    {
        failed = true;
        reason = error.what();
    }
    std::fesetenv(&traps);

    if (failed)
    {
        FatalIOErrorInFunction(dict_) << reason << exit(FatalIOError);
    }
}


Foam::scalar Foam::solidsRecord::duration() const
{
    return reader_->windows().back().end - reader_->time0();
}


void Foam::solidsRecord::checkTime0() const
{
    scalar time0;
    if (dict_.readIfPresent("time0", time0) &&
        mag(time0 - reader_->time0()) > reader_->timestep())
    {
        FatalIOErrorInFunction(dict_)
            << "time0 is " << time0 << " s but " << file_
            << " begins at DEM time " << reader_->time0() << " s: the mesh"
            << " would be turned against the solids. Make the mesh with"
            << " millMesh --at-time " << reader_->time0()
            << " or average from --start " << time0 << exit(FatalIOError);
    }
}


void Foam::solidsRecord::checkGaps() const
{
    const auto& windows = reader_->windows();
    for (std::size_t i = 1; i < windows.size(); ++i)
    {
        if (mag(windows[i].begin - windows[i - 1].end) >
            reader_->timestep() / 2)
        {
            FatalIOErrorInFunction(dict_)
                << file_ << ": no solids between DEM times "
                << windows[i - 1].end << " s and " << windows[i].begin
                << " s; expected windows without a gap" << exit(FatalIOError);
        }
    }
}


Foam::label Foam::solidsRecord::windowAt(const scalar t) const
{
    const auto& windows = reader_->windows();
    const label last = label(windows.size()) - 1;

    // Half a DEM step: times that should agree may differ by rounding
    const scalar tolerance = reader_->timestep() / 2;

    scalar elapsed = t;
    if (outOfRange_ == range::repeat)
    {
        elapsed -= duration() * std::floor((t + tolerance) / duration());
    }
    else if (outOfRange_ == range::hold)
    {
        elapsed = max(scalar(0), min(t, duration()));
    }

    if (elapsed < -tolerance || elapsed > duration() + tolerance)
    {
        FatalIOErrorInFunction(dict_)
            << file_ << " records DEM times " << reader_->time0() << " to "
            << windows.back().end << " s, that is flow times 0 to "
            << duration() << " s, but the flow needs " << t << " s."
            << " Shorten the flow (endTime), record more, or choose"
            << " outOfRange hold or repeat" << exit(FatalIOError);
    }

    label number = 0;
    while (number < last &&
           reader_->time0() + elapsed + tolerance >= windows[number].end)
    {
        ++number;
    }
    return number;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsRecord::solidsRecord(const dictionary& dict, const Time& time)
: dict_(dict),
  file_(dict.get<fileName>("solids").expand()),
  interpolation_(interpolationNames_.get("interpolation", dict)),
  outOfRange_(rangeNames_.getOrDefault("outOfRange", dict, range::error)),
  number_(-1)
{
    if (!file_.isAbsolute())
    {
        file_ = time.globalPath() / file_;
    }

    guarded(
        [this]()
        {
            reader_ = std::make_unique<millfoam::averaging::SolidsReader>(
                std::string(file_));
        });

    checkTime0();
    checkGaps();

    if (reader_->whole_run())
    {
        outOfRange_ = range::hold;
    }
    windowAt(time.startTime().value());
    // Without a set end (stopAt nextWrite and its kin) only the run can tell
    if (time.endTime().value() < GREAT)
    {
        windowAt(time.endTime().value());
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::solidsRecord::sample(
    const scalar t, const UList<point>& at, scalarField& solidity,
    vectorField& velocity, scalarField& diameter)
{
    const label wanted = windowAt(t);
    if (wanted != number_)
    {
        guarded([&]() { window_ = reader_->read_window(wanted); });
        number_ = wanted;
    }

    label uncovered = 0;
    forAll(at, i)
    {
        const point& p = at[i];
        const millfoam::averaging::LocalSolids solids =
            millfoam::averaging::sample(
                reader_->grid(), window_, {p.x(), p.y(), p.z()},
                interpolation_);
        solidity[i] = solids.solidity;
        velocity[i] =
            vector(solids.velocity[0], solids.velocity[1], solids.velocity[2]);
        diameter[i] = solids.diameter;
        uncovered += solids.inside ? 0 : 1;
    }
    return uncovered;
}


Foam::string Foam::solidsRecord::description() const
{
    OStringStream text;
    text << label(reader_->windows().size()) << " windows of " << file_
         << ", DEM times " << reader_->time0() << " to "
         << reader_->windows().back().end << " s, "
         << interpolationNames_[interpolation_] << " interpolation, "
         << rangeNames_[outOfRange_] << " beyond";
    return text.str();
}


// ************************************************************************* //
