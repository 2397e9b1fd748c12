/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "timeStep.H"

#include <algorithm>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::timeStep::watch(const scalar deltaT, const word& cause)
{
    steps_.append(deltaT);
    List<scalar> sorted(steps_);
    const label middle = sorted.size() / 2;
    std::nth_element(sorted.begin(), sorted.begin() + middle, sorted.end());
    const scalar median = sorted[middle];

    // Not at the end of a run or before a written time: only Courant numbers
    // that are beyond all bounds lead there
    if (!(deltaT > 1e-6 * median))
    {
        FatalErrorInFunction
            << "time-step " << deltaT << " s, median so far " << median
            << " s, because of the " << cause << ": the flow has diverged at "
            << time_.value() << " s. Resume from an earlier written time with"
            << " smaller maxCo and maxAlphaCo, and look at U there"
            << exit(FatalError);
    }

    const bool isShort = deltaT < median / 20;
    if (isShort && !reported_)
    {
        WarningInFunction << "time-step " << deltaT
                          << " s is below a twentieth of its"
                          << " median so far, " << median
                          << " s, because of the " << cause << endl;
    }
    reported_ = isShort;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeStep::timeStep(Time& time)
: time_(time),
  steps_(),
  reported_(false)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

std::optional<millfoam::record::StepLimits>
Foam::timeStep::limits(const dictionary& control)
{
    if (!control.lookupOrDefault("adjustTimeStep", false))
    {
        return std::nullopt;
    }
    millfoam::record::StepLimits result;
    result.courant = control.get<scalar>("maxCo");
    result.surface_courant = control.get<scalar>("maxAlphaCo");
    result.voidage_change =
        control.lookupOrDefault<scalar>("maxVoidageChange", 0.1);
    scalar deltaT;
    if (control.readIfPresent("maxDeltaT", deltaT))
    {
        result.delta_t = deltaT;
    }
    return result;
}


void Foam::timeStep::adjust(const FixedList<scalar, 4>& courant)
{
    Info << "Courant number " << courant[0] << ", at the surface " << courant[1]
         << ", change of voidage " << courant[2] << endl;

    const auto asked = limits(time_.controlDict());
    if (!asked)
    {
        return;
    }

    const FixedList<word, 4> causes{
        "flow", "flow at the surface", "change of voidage", "surface tension"};
    const FixedList<scalar, 4> bounds{
        asked->courant, asked->surface_courant, asked->voidage_change, 0.5};

    scalar factor = 1.2;
    word cause("growth from a short step");
    forAll(bounds, i)
    {
        const scalar allowed = bounds[i] / max(courant[i], SMALL);
        if (allowed < factor)
        {
            factor = allowed;
            cause = causes[i];
        }
    }
    const scalar deltaT =
        min(factor * time_.deltaTValue(), asked->delta_t.value_or(GREAT));
    time_.setDeltaT(deltaT);
    Info << "deltaT = " << time_.deltaTValue() << endl;
    watch(deltaT, cause);
}


// ************************************************************************* //
