/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsClock.H"
#include "readableLog.H"
#include "Time.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::solidsClock::range> Foam::solidsClock::rangeNames_({
    {range::error, "error"},
    {range::hold, "hold"},
    {range::repeat, "repeat"},
});

const Foam::Enum<Foam::solidsClock::course> Foam::solidsClock::courseNames_({
    {course::window, "window"},
    {course::smooth, "smooth"},
});


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::solidsClock::checkTime0() const
{
    scalar time0;
    if (dict_.readIfPresent("time0", time0) &&
        mag(time0 - time0_) > 2 * tolerance_)
    {
        FatalIOErrorInFunction(dict_)
            << "time0 is " << time0 << " s but " << file_
            << " begins at DEM time " << time0_ << " s: the mesh would be"
            << " at another angle than the solids. Make the mesh with"
            << " millMesh --at-time " << time0_ << " or average from --start "
            << time0 << exit(FatalIOError);
    }
}


void Foam::solidsClock::checkGaps() const
{
    for (std::size_t i = 1; i < windows_.size(); ++i)
    {
        if (mag(windows_[i].begin - windows_[i - 1].end) > tolerance_)
        {
            FatalIOErrorInFunction(dict_)
                << file_ << ": no solids between DEM times "
                << windows_[i - 1].end << " s and " << windows_[i].begin
                << " s; expected windows without a gap" << exit(FatalIOError);
        }
    }
}


bool Foam::solidsClock::endsTheFlow(const scalar t) const
{
    const scalar end = time_.endTime().value();
    return end <= duration() + tolerance_ && t < end + time_.deltaTValue();
}


Foam::scalar Foam::solidsClock::recorded(const scalar t) const
{
    scalar elapsed = t;
    if (outOfRange_ == range::repeat)
    {
        elapsed -= duration() * std::floor((t + tolerance_) / duration());
    }
    else if (outOfRange_ == range::hold)
    {
        elapsed = max(scalar(0), min(t, duration()));
    }
    else if (t > duration() && endsTheFlow(t))
    {
        elapsed = duration();
    }

    if (elapsed < -tolerance_ || elapsed > duration() + tolerance_)
    {
        FatalIOErrorInFunction(dict_)
            << file_ << " records DEM times " << time0_ << " to "
            << windows_.back().end << " s, that is flow times 0 to "
            << duration() << " s, but the flow needs " << t << " s."
            << " Shorten the flow (endTime), record more, or choose"
            << " outOfRange hold or repeat" << exit(FatalIOError);
    }

    return elapsed;
}


Foam::label Foam::solidsClock::windowAt(const scalar elapsed) const
{
    const label last = label(windows_.size()) - 1;
    label number = 0;
    while (number < last &&
           time0_ + elapsed + tolerance_ >= windows_[number].end)
    {
        ++number;
    }
    return number;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsClock::solidsClock(
    const dictionary& dict, const fileName& file,
    const millfoam::averaging::SolidsReader& reader, const Time& time)
: dict_(dict),
  file_(file),
  time_(time),
  windows_(reader.windows()),
  time0_(reader.time0()),
  tolerance_(reader.timestep() / 2),
  outOfRange_(rangeNames_.getOrDefault("outOfRange", dict, range::error)),
  inTime_(courseNames_.getOrDefault("inTime", dict, course::smooth))
{
    checkTime0();
    checkGaps();

    if (reader.whole_run())
    {
        outOfRange_ = range::hold;
    }

    std::vector<double> lengths;
    lengths.reserve(windows_.size());
    for (const auto& window : windows_)
    {
        lengths.push_back(window.end - window.begin);
    }
    spline_.reset(new millfoam::averaging::TimeSpline(
        lengths, outOfRange_ == range::repeat));
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::solidsClock::moment Foam::solidsClock::at(const scalar t) const
{
    const scalar elapsed = recorded(t);
    const std::size_t own = windowAt(elapsed);
    if (inTime_ == course::window)
    {
        return {{own, own, own}, {0, 1, 0}};
    }
    const auto& window = windows_[own];
    const scalar share =
        (time0_ + elapsed - window.begin) / (window.end - window.begin);
    return spline_->at(own, min(max(share, scalar(0)), scalar(1)));
}


Foam::scalar Foam::solidsClock::duration() const
{
    return windows_.back().end - time0_;
}


void Foam::solidsClock::checkSpan() const
{
    recorded(time_.startTime().value());
    // Without a set end (stopAt nextWrite and others) only the run knows
    if (time_.endTime().value() < GREAT)
    {
        recorded(time_.endTime().value());
    }
}


millfoam::record::Solids Foam::solidsClock::forRecord() const
{
    millfoam::record::Solids result;
    result.begin = time0_;
    result.end = windows_.back().end;
    result.windows = static_cast<long long>(windows_.size());
    result.in_time = courseNames_[inTime_];
    result.out_of_range = rangeNames_[outOfRange_];
    return result;
}


Foam::string Foam::solidsClock::description() const
{
    readableText text;
    text << label(windows_.size()) << " windows of " << file_ << ", DEM times "
         << time0_ << " to " << windows_.back().end << " s, "
         << (inTime_ == course::smooth ? "smooth in time, " : "")
         << rangeNames_[outOfRange_] << " beyond";
    return text.str();
}


// ************************************************************************* //
