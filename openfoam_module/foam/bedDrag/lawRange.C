/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "lawRange.H"
#include "readableLog.H"
#include "PstreamReduceOps.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::lawRange::share(const sum volume) const
{
    return sums_[all] > 0 ? sums_[volume] / sums_[all] : 0;
}


Foam::string Foam::lawRange::bounds() const
{
    const millfoam::drag::Range& range = law_.range;
    readableText text;
    const auto tell =
        [&](const sum volume, const char* name, const scalar bound)
    {
        if (sums_[volume] > 0)
        {
            text << (text.str().empty() ? "" : ", ") << name << " " << bound
                 << " in " << 100 * share(volume) << " %";
        }
    };
    tell(phiLow, "solidity below", range.phi_min);
    tell(phiHigh, "solidity above", range.phi_max);
    tell(reLow, "Re below", range.re_min);
    tell(reHigh, "Re above", range.re_max);
    return text.str();
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::lawRange::lawRange(const millfoam::drag::Law& law)
: law_(law),
  name_(std::string(law.name)),
  sums_(nSums, Zero),
  largest_(0),
  integral_(0),
  time_(0),
  warned_(false)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::lawRange::begin()
{
    sums_ = Zero;
}


void Foam::lawRange::count(
    const scalar phi, const scalar re, const scalar volume)
{
    sums_[all] += volume;
    if (millfoam::drag::within(law_.range, phi, re))
        return;

    const millfoam::drag::Range& range = law_.range;
    sums_[cells] += 1;
    sums_[outside] += volume;
    sums_[phiLow] += phi < range.phi_min ? volume : 0;
    sums_[phiHigh] += phi > range.phi_max ? volume : 0;
    sums_[reLow] += re < range.re_min ? volume : 0;
    sums_[reHigh] += re > range.re_max ? volume : 0;
}


void Foam::lawRange::end(const scalar deltaT)
{
    reduce(sums_, sumOp<scalarField>());

    largest_ = max(largest_, share(outside));
    integral_ += share(outside) * deltaT;
    time_ += deltaT;

    if (sums_[cells] > 0 && !warned_)
    {
        warned_ = true;
        WarningInFunction
            << name_.c_str() << " is used beyond its range in "
            << 100 * share(outside) << " % of the slurry in the bed ("
            << label(sums_[cells]) << " cells): " << bounds().c_str()
            << ". Compare with another law (millDrag --ranges); how much it is"
            << " is told in every time-step" << endl;
    }
}


Foam::lawRange::shares Foam::lawRange::present() const
{
    return {
        share(outside), share(phiLow), share(phiHigh), share(reLow),
        share(reHigh)};
}


Foam::string Foam::lawRange::description() const
{
    readableText text;
    text << "beyond " << name_.c_str() << "'s range " << label(sums_[cells])
         << " cells, " << 100 * share(outside) << " % of the slurry in the bed";
    return text.str();
}


Foam::string Foam::lawRange::summary() const
{
    readableText text;
    text << "beyond " << name_.c_str() << "'s range: at most " << 100 * largest_
         << " % of the slurry in the bed, in the mean over " << time_ << " s "
         << (time_ > 0 ? 100 * integral_ / time_ : 0) << " %";
    return text.str();
}


// ************************************************************************* //
