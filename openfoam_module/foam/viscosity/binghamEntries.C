/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "binghamEntries.H"
#include "knownEntries.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::binghamEntries::regularisation>
    Foam::binghamEntries::regularisationNames_({
        {regularisation::biviscosity, "biviscosity"},
        {regularisation::Papanastasiou, "Papanastasiou"},
    });


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Entry that must be there and above zero (or at least zero)
scalar readBounded(
    const dictionary& dict, const word& key, const bool zeroAllowed = false)
{
    const scalar value = dict.get<scalar>(key);
    if (value < 0 || (value == 0 && !zeroAllowed))
    {
        FatalIOErrorInFunction(dict)
            << key << " is " << value << "; expected a value "
            << (zeroAllowed ? "not below" : "above") << " zero"
            << exit(FatalIOError);
    }
    return value;
}


//- The entries of the model. A phase's dictionary has others, too, of which
//  each with one letter or two is nearly m
const dictionary& modelEntries(const dictionary& phase)
{
    wordList known(
        {"yieldStress", "plasticViscosity", "regularisation",
         "viscosityRatio"});
    const dictionary& coeffs = phase.optionalSubDict("BinghamCoeffs");
    if (&coeffs == &phase)
    {
        refuseMisspelt(coeffs, known);
    }
    else
    {
        known.append("m");
        requireKnownEntries(coeffs, known);
    }
    return coeffs;
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::binghamEntries::binghamEntries(const dictionary& phase)
: density(readBounded(phase, "rho")),
  yieldStress(0),
  plasticViscosity(0),
  form(regularisation::biviscosity),
  viscosityRatio(0),
  m(0)
{
    const dictionary& coeffs = modelEntries(phase);
    form = regularisationNames_.getOrDefault("regularisation", coeffs, form);
    yieldStress = readBounded(coeffs, "yieldStress", true);
    plasticViscosity = readBounded(coeffs, "plasticViscosity");
    if (form == regularisation::biviscosity)
    {
        viscosityRatio = readBounded(coeffs, "viscosityRatio");
        if (viscosityRatio < 1)
        {
            FatalIOErrorInFunction(coeffs)
                << "viscosityRatio is " << viscosityRatio
                << "; expected 1 or more: the largest viscosity over the"
                << " plastic one" << exit(FatalIOError);
        }
    }
    else
    {
        m = readBounded(coeffs, "m");
    }
}


// ************************************************************************* //
