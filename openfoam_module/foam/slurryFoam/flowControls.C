/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowControls.H"
#include "fvMesh.H"
#include "IOdictionary.H"
#include "optionalDictionary.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

void checkTimeSchemes(const dictionary& schemes)
{
    for (const entry& one : schemes)
    {
        const word scheme(one.isStream() ? word(one.stream()) : word("{"));
        if (scheme != "Euler" && scheme != "none")
        {
            FatalIOErrorInFunction(schemes)
                << one.keyword() << " is " << scheme
                << "; expected Euler: slurryFoam knows no other scheme in time"
                << exit(FatalIOError);
        }
    }
}


void checkPredictor(const dictionary& pimple)
{
    if (!pimple.lookupOrDefault<Switch>("momentumPredictor", true))
    {
        FatalIOErrorInFunction(pimple)
            << "momentumPredictor is no; expected yes: slurryFoam always"
            << " predicts the momentum" << exit(FatalIOError);
    }
}


void checkCorrectors(const dictionary& pimple)
{
    for (const word name : {"nOuterCorrectors", "nCorrectors"})
    {
        const label number = pimple.lookupOrDefault<label>(name, 1);
        if (number < 1)
        {
            FatalIOErrorInFunction(pimple)
                << name << " is " << number << "; expected 1 or more, because"
                << " nothing moves without a correction" << exit(FatalIOError);
        }
    }
}


//- Before the balls of an exchange are waited for
void checkSuction(const dictionary& bed)
{
    if (bed.found("poreSuction") && bed.found("exchange"))
    {
        FatalIOErrorInFunction(bed)
            << "poreSuction is there with exchange, but balls do not feel the"
            << " suction of their pores; expected one of them"
            << exit(FatalIOError);
    }
}


void checkPatches(const fvMesh& mesh)
{
    for (const fvPatch& patch : mesh.boundary())
    {
        if (patch.type() == "cyclicAMI" || patch.type() == "cyclicACMI")
        {
            FatalErrorInFunction
                << "patch " << patch.name() << " is a " << patch.type()
                << ", through which slurryFoam cannot carry slurry; expected"
                << " cyclic patches whose faces match" << exit(FatalError);
        }
    }
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::checkFlowControls(const fvMesh& mesh)
{
    checkTimeSchemes(mesh.schemesDict().subOrEmptyDict("ddtSchemes"));
    const dictionary pimple(mesh.solutionDict().subOrEmptyDict("PIMPLE"));
    checkPredictor(pimple);
    checkCorrectors(pimple);
    checkSuction(
        IOdictionary(optionalDictionary("bedProperties", mesh.time(), false)));
    checkPatches(mesh);
}


// ************************************************************************* //
