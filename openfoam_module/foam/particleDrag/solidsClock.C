/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsClock.H"
#include "OStringStream.H"
#include "Time.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::solidsClock::range> Foam::solidsClock::rangeNames_({
    {range::error, "error"},
    {range::hold, "hold"},
    {range::repeat, "repeat"},
});


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::solidsClock::duration() const
{
    return windows_.back().end - time0_;
}


void Foam::solidsClock::checkTime0() const
{
    scalar time0;
    if (dict_.readIfPresent("time0", time0) &&
        mag(time0 - time0_) > 2 * tolerance_)
    {
        FatalIOErrorInFunction(dict_)
            << "time0 is " << time0 << " s but " << file_
            << " begins at DEM time " << time0_ << " s: the mesh would be"
            << " turned against the solids. Make the mesh with"
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


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsClock::solidsClock(
    const dictionary& dict, const fileName& file,
    const millfoam::averaging::SolidsReader& reader)
: dict_(dict),
  file_(file),
  windows_(reader.windows()),
  time0_(reader.time0()),
  tolerance_(reader.timestep() / 2),
  outOfRange_(rangeNames_.getOrDefault("outOfRange", dict, range::error))
{
    checkTime0();
    checkGaps();

    if (reader.whole_run())
    {
        outOfRange_ = range::hold;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::solidsClock::windowAt(const scalar t) const
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

    if (elapsed < -tolerance_ || elapsed > duration() + tolerance_)
    {
        FatalIOErrorInFunction(dict_)
            << file_ << " records DEM times " << time0_ << " to "
            << windows_.back().end << " s, that is flow times 0 to "
            << duration() << " s, but the flow needs " << t << " s."
            << " Shorten the flow (endTime), record more, or choose"
            << " outOfRange hold or repeat" << exit(FatalIOError);
    }

    const label last = label(windows_.size()) - 1;
    label number = 0;
    while (number < last &&
           time0_ + elapsed + tolerance_ >= windows_[number].end)
    {
        ++number;
    }
    return number;
}


void Foam::solidsClock::checkSpan(const Time& time) const
{
    windowAt(time.startTime().value());
    // Without a set end (stopAt nextWrite and its kin) only the run can tell
    if (time.endTime().value() < GREAT)
    {
        windowAt(time.endTime().value());
    }
}


Foam::string Foam::solidsClock::description() const
{
    OStringStream text;
    text << label(windows_.size()) << " windows of " << file_ << ", DEM times "
         << time0_ << " to " << windows_.back().end << " s, "
         << rangeNames_[outOfRange_] << " beyond";
    return text.str();
}


// ************************************************************************* //
