/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "mixtureFluids.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::bedFluids Foam::fluidsOf(const incompressibleTwoPhaseMixture& mixture)
{
    const dictionary& slurry = mixture.subDict(mixture.phase1Name());
    bedFluids result;
    result.air = {
        mixture.rho2().value(),
        mixture.rho2().value() * gMax(mixture.nuModel2().nu()())};
    result.slurry.density = mixture.rho1().value();
    if (const dictionary* bingham = slurry.findDict("BinghamCoeffs"))
    {
        result.slurry.viscosity = bingham->get<scalar>("plasticViscosity");
        result.yieldStress = bingham->get<scalar>("yieldStress");
        result.largestViscosity =
            result.slurry.viscosity * bingham->get<scalar>("viscosityRatio");
    }
    else
    {
        result.slurry.viscosity =
            mixture.rho1().value() * gMax(mixture.nuModel1().nu()());
    }
    return result;
}


// ************************************************************************* //
