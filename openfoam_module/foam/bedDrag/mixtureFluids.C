/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "mixtureFluids.H"
#include "flowCurve.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::bedFluids Foam::fluidsOf(const incompressibleTwoPhaseMixture& mixture)
{
    const dictionary& airDict = mixture.subDict(mixture.phase2Name());
    const millfoam::drag::FlowCurve air(flowCurveOf(airDict));
    if (air.model() != "Newtonian")
    {
        FatalIOErrorInFunction(airDict)
            << "transportModel is " << air.model().c_str()
            << "; expected Newtonian for air" << exit(FatalIOError);
    }
    return {
        {mixture.rho2().value(), *air.plastic_viscosity()},
        mixture.rho1().value(),
        flowCurveOf(mixture.subDict(mixture.phase1Name()))};
}


// ************************************************************************* //
