/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "flowControls.H"
#include "fvMesh.H"

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
    checkPredictor(mesh.solutionDict().subOrEmptyDict("PIMPLE"));
    checkPatches(mesh);
}


// ************************************************************************* //
