/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryViscosity.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::slurryViscosity::choice>
    Foam::slurryViscosity::choiceNames_({
        {choice::plastic, "plastic"},
        {choice::pore, "pore"},
    });


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slurryViscosity::slurryViscosity(
    const dictionary& dict, const millfoam::drag::FlowCurve& curve)
: choice_(choiceNames_.getOrDefault(
      "viscosity", dict,
      curve.plastic_viscosity() ? choice::plastic : choice::pore)),
  curve_(curve)
{
    if (choice_ == choice::plastic && !curve.plastic_viscosity())
    {
        FatalIOErrorInFunction(dict)
            << "viscosity is plastic, but the slurry's model "
            << curve.model().c_str() << " has no plastic viscosity; expected"
            << " viscosity pore (flow.viscosity in mill.yaml)"
            << exit(FatalIOError);
    }
}


// ************************************************************************* //
