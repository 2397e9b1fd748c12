/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "timeStep.H"
#include "knownEntries.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Entries of controlDict that bound the time-step
static const wordList bounds_(
    {"maxCo", "maxAlphaCo", "maxAirCo", "maxVoidageChange", "maxDeltaT"});


//- Refuse bounds that are misspelt, or not above 0
static void checkBounds(const dictionary& control)
{
    wordList known(bounds_);
    known.append("adjustTimeStep");
    refuseMisspelt(control, known);
    requireAboveZero(control, bounds_);
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::timeStep::watch(const scalar deltaT, const word& cause)
{
    using millfoam::record::StepLength;

    const scalar median = watched_.median();
    switch (watched_.add(deltaT))
    {
    // Not at the end of a run or before a written time: only Courant
    // numbers that are beyond all bounds lead there
    case StepLength::diverged:
        FatalErrorInFunction
            << "time-step " << deltaT << " s, median so far " << median
            << " s, because of the " << cause << ": the flow has diverged"
            << " at " << time_.value() << " s. Resume from an earlier"
            << " written time with smaller maxCo and maxAlphaCo, and look"
            << " at U there" << exit(FatalError);
        break;

    case StepLength::begins_short:
        WarningInFunction << "time-step " << deltaT
                          << " s is below a twentieth of its"
                          << " median so far, " << median
                          << " s, because of the " << cause << endl;
        break;

    default:
        break;
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeStep::timeStep(Time& time)
: time_(time),
  watched_()
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

std::optional<millfoam::record::StepLimits>
Foam::timeStep::limits(const dictionary& control)
{
    checkBounds(control);
    if (!control.lookupOrDefault("adjustTimeStep", false))
    {
        return std::nullopt;
    }
    millfoam::record::StepLimits result;
    result.courant = control.get<scalar>("maxCo");
    result.surface_courant = control.get<scalar>("maxAlphaCo");
    result.air_courant =
        control.lookupOrDefault<scalar>("maxAirCo", result.courant);
    result.voidage_change =
        control.lookupOrDefault<scalar>("maxVoidageChange", 0.1);
    scalar deltaT;
    if (control.readIfPresent("maxDeltaT", deltaT))
    {
        result.delta_t = deltaT;
    }
    return result;
}


void Foam::timeStep::adjust(const courantNumbers& courant)
{
    Info << "Courant number " << courant.flow << ", at the surface "
         << courant.surface << ", of air " << courant.air
         << ", change of voidage " << courant.voidageChange << endl;

    const auto asked = limits(time_.controlDict());
    if (!asked)
    {
        return;
    }

    scalar factor = 1.2;
    word cause("growth from a short step");
    const auto keep = [&](const scalar bound, const scalar now, const char* why)
    {
        const scalar allowed = bound / max(now, SMALL);
        if (allowed < factor)
        {
            factor = allowed;
            cause = why;
        }
    };
    keep(asked->courant, courant.flow, "flow");
    keep(asked->surface_courant, courant.surface, "flow at the surface");
    keep(asked->air_courant, courant.air, "flow of air");
    keep(asked->voidage_change, courant.voidageChange, "change of voidage");
    keep(0.5, courant.capillary, "surface tension");
    const scalar deltaT =
        min(factor * time_.deltaTValue(), asked->delta_t.value_or(GREAT));
    time_.setDeltaT(deltaT);
    Info << "deltaT = " << time_.deltaTValue() << endl;
    watch(deltaT, cause);
}


// ************************************************************************* //
