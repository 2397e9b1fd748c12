/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshSpeed.H"
#include "Constant.H"
#include "Function1.H"
#include "IOdictionary.H"
#include "IStringStream.H"
#include "meshRotation.H"
#include "optionalDictionary.H"
#include "OStringStream.H"
#include "staticFvMesh.H"
#include "volFields.H"
#include "wallFvPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Of a wall's own velocity, what is known
enum class wallMotion
{
    withMesh,
    rests,
    turns,
    unknown
};


//- Angular speed about z of a wall with rotatingWallVelocity, rad/s, GREAT of one
//  that turns about another axis; none where it is a function of time. The
//  class of the wall does not give its entries
std::optional<scalar> turnOf(const fvPatchVectorField& wall)
{
    OStringStream text;
    text.precision(17); // Of all digits, whatever writePrecision is
    wall.write(text);
    const dictionary dict(IStringStream(text.str())());
    const autoPtr<Function1<scalar>> omega(
        Function1<scalar>::New("omega", dict));
    if (!isA<Function1Types::Constant<scalar>>(omega()))
    {
        return std::nullopt;
    }
    const vector axis(dict.get<vector>("axis"));
    const scalar speed = omega->value(0);
    const bool aboutZ = mag(axis) - mag(axis.z()) <= 1e-6 * mag(axis);
    return speed == 0 ? 0 : aboutZ ? speed * sign(axis.z()) : GREAT;
}


//- What a wall does. Call it on all ranks
wallMotion motionOf(const fvPatchVectorField& wall)
{
    if (wall.type() == "movingWallVelocity")
    {
        return wallMotion::withMesh;
    }
    if (wall.type() == "rotatingWallVelocity")
    {
        const std::optional<scalar> speed(turnOf(wall));
        return speed && *speed == 0 ? wallMotion::rests : wallMotion::turns;
    }
    if (wall.type() == "noSlip" ||
        (wall.type() == "fixedValue" && !(gMax(mag(wall)()) > 0)))
    {
        return wallMotion::rests;
    }
    return wallMotion::unknown;
}


//- Names of the walls with this motion
wordList wallsThat(const volVectorField& U, const wallMotion motion)
{
    wordList names;
    for (const fvPatchVectorField& patch : U.boundaryField())
    {
        if (isA<wallFvPatch>(patch.patch()) && motionOf(patch) == motion)
        {
            names.append(patch.patch().name());
        }
    }
    return names;
}


//- Refuse walls that turn with another speed, or about another axis, than the
//  mill
void checkTurningWalls(
    const volVectorField& U, const IOdictionary& mill, const scalar omega)
{
    for (const fvPatchVectorField& patch : U.boundaryField())
    {
        const std::optional<scalar> speed(
            patch.type() == "rotatingWallVelocity" ? turnOf(patch)
                                                   : std::nullopt);
        if (speed && *speed != 0 &&
            mag(*speed - omega) > 1e-6 * max(mag(*speed), mag(omega)))
        {
            OStringStream digits; // More than writePrecision may have
            digits.precision(15);
            digits << omega;
            FatalIOErrorInFunction(mill)
                << "omega is " << omega << " rad/s about z, but the wall "
                << patch.patch().name() << " of U has rotatingWallVelocity"
                << " with another omega or axis; expected 'omega "
                << digits.str().c_str() << ";' and 'axis (0 0 1);' there, or"
                << " noSlip at a wall that rests" << exit(FatalIOError);
        }
    }
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

    checkTurningWalls(U, mill, omega);
    if (*speed != 0 || omega == 0)
    {
        return;
    }
    const wordList walls(wallsThat(U, wallMotion::withMesh));
    if (!walls.empty())
    {
        FatalIOErrorInFunction(mill)
            << "omega is " << omega << " rad/s but the mesh does not turn, and"
            << " with it rest the walls " << walls << ", at which U has"
            << " movingWallVelocity; expected a constant/dynamicMeshDict with"
            << " rotatingMotion and 'omega $omega;', or rotatingWallVelocity"
            << " at walls that turn and noSlip at others" << exit(FatalIOError);
    }
    const wordList resting(wallsThat(U, wallMotion::rests));
    if (!resting.empty() && wallsThat(U, wallMotion::turns).empty() &&
        wallsThat(U, wallMotion::unknown).empty())
    {
        FatalIOErrorInFunction(mill)
            << "omega is " << omega << " rad/s but neither the mesh turns nor"
            << " any wall: of U the walls " << resting << " rest; expected a"
            << " constant/dynamicMeshDict with rotatingMotion and 'omega"
            << " $omega;', or rotatingWallVelocity at walls that turn, or"
            << " omega 0 of a mill at rest" << exit(FatalIOError);
    }
}


// ************************************************************************* //
