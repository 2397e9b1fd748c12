/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowCurve.H"
#include "binghamEntries.H"
#include "dimensionedScalar.H"

#include <map>
#include <stdexcept>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

using millfoam::drag::FlowCurve;

//- The entries of a model: kinematic ones come out as dynamic ones
class curveEntries
{
    const dictionary& phase_;
    const dictionary& dict_;
    scalar density_;

    scalar value(const word& key, const dimensionSet& dimensions) const
    {
        const scalar found = dimensionedScalar(key, dimensions, dict_).value();
        if (!(found >= 0))
        {
            FatalIOErrorInFunction(dict_)
                << key << " is " << found << "; expected a value not below zero"
                << exit(FatalIOError);
        }
        return found;
    }


    public:
    curveEntries(const dictionary& phase, const word& model)
    : phase_(phase),
      dict_(phase.optionalSubDict(model + "Coeffs")),
      density_(dimensionedScalar("rho", dimDensity, phase).value())
    {
    }

    //- Pa s, of an entry in m2/s; the same for a consistency
    scalar viscosity(const word& key) const
    {
        return density_ * value(key, dimViscosity);
    }

    //- Pa, of an entry in m2/s2
    scalar stress(const word& key) const
    {
        return density_ * value(key, dimViscosity / dimTime);
    }

    scalar time(const word& key) const
    {
        return value(key, dimTime);
    }

    scalar exponent(const word& key) const
    {
        return value(key, dimless);
    }

    //- The phase's dictionary
    const dictionary& phase() const
    {
        return phase_;
    }
};


FlowCurve bingham(const curveEntries& entries)
{
    const binghamEntries of(entries.phase());
    if (of.form == binghamEntries::regularisation::Papanastasiou)
    {
        return FlowCurve::papanastasiou(
            of.yieldStress, of.plasticViscosity, of.m);
    }
    return FlowCurve::bingham(
        of.yieldStress, of.plasticViscosity,
        of.plasticViscosity * of.viscosityRatio);
}


using maker = FlowCurve (*)(const curveEntries&);

const std::map<word, maker> makers{
    {"Newtonian", [](const curveEntries& entries)
     { return FlowCurve::newtonian(entries.viscosity("nu")); }},
    {"Bingham", &bingham},
    {"HerschelBulkley",
     [](const curveEntries& entries)
     {
         return FlowCurve::herschel_bulkley(
             entries.stress("tau0"), entries.viscosity("k"),
             entries.exponent("n"), entries.viscosity("nu0"));
     }},
    {"Casson",
     [](const curveEntries& entries)
     {
         return FlowCurve::casson(
             entries.stress("tau0"), entries.viscosity("m"),
             entries.viscosity("nuMin"), entries.viscosity("nuMax"));
     }},
    {"CrossPowerLaw",
     [](const curveEntries& entries)
     {
         return FlowCurve::cross(
             entries.viscosity("nu0"), entries.viscosity("nuInf"),
             entries.time("m"), entries.exponent("n"));
     }},
    {"powerLaw",
     [](const curveEntries& entries)
     {
         return FlowCurve::power_law(
             entries.viscosity("k"), entries.exponent("n"),
             entries.viscosity("nuMin"), entries.viscosity("nuMax"));
     }},
};

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

millfoam::drag::FlowCurve Foam::flowCurveOf(const dictionary& phase)
{
    const word model(phase.get<word>("transportModel"));
    const auto found = makers.find(model);
    if (found == makers.end())
    {
        wordList known;
        for (const auto& one : makers)
        {
            known.append(one.first);
        }
        FatalIOErrorInFunction(phase)
            << "transportModel is " << model << ", whose viscosity in the pores"
            << " of a bed is not known; expected one of " << flatOutput(known)
            << exit(FatalIOError);
    }
    std::string reason;
    try
    {
        return found->second(curveEntries(phase, model));
    }
    catch (const std::invalid_argument& error)
    {
        reason = error.what();
    }
    FatalIOErrorInFunction(phase)
        << model << ": " << reason.c_str() << exit(FatalIOError);
    return FlowCurve::newtonian(1);
}


// ************************************************************************* //
