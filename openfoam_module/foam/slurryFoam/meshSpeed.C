/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshSpeed.H"
#include "IOdictionary.H"
#include "meshRotation.H"
#include "optionalDictionary.H"
#include "staticFvMesh.H"
#include "volFields.H"
#include "wallFvPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Names of the walls that move with the mesh
wordList wallsOfMesh(const volVectorField& U)
{
    wordList names;
    for (const fvPatchVectorField& patch : U.boundaryField())
    {
        if (isA<wallFvPatch>(patch.patch()) &&
            patch.type() == "movingWallVelocity")
        {
            names.append(patch.patch().name());
        }
    }
    return names;
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::checkMeshSpeed(const volVectorField& U)
{
    const Time& time = U.time();
    const IOdictionary mill(optionalDictionary("millProperties", time, false));
    const std::optional<scalar> speed = isA<staticFvMesh>(U.mesh())
                                            ? std::optional<scalar>(0)
                                            : constantMeshRotation(time);
    scalar omega = 0;
    if (!mill.readIfPresent("omega", omega) || !speed)
    {
        return;
    }

    if (*speed != 0 &&
        mag(*speed - omega) > 1e-6 * max(mag(*speed), mag(omega)))
    {
        FatalIOErrorInFunction(mill)
            << "omega is " << omega << " rad/s but constant/dynamicMeshDict"
            << " turns the mesh with " << *speed << " rad/s about z; expected"
            << " 'omega $omega;' and 'axis (0 0 1);' there. For another speed"
            << " of the mill run millMesh again" << exit(FatalIOError);
    }

    const wordList walls(
        *speed == 0 && omega != 0 ? wallsOfMesh(U) : wordList());
    if (!walls.empty())
    {
        FatalIOErrorInFunction(mill)
            << "omega is " << omega << " rad/s but the mesh does not turn, and"
            << " with it rest the walls " << walls << ", at which U has"
            << " movingWallVelocity; expected a constant/dynamicMeshDict with"
            << " rotatingMotion and 'omega $omega;', or rotatingWallVelocity"
            << " at walls that turn and noSlip at others" << exit(FatalIOError);
    }
}


// ************************************************************************* //
