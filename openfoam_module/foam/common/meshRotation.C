/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshRotation.H"
#include "Constant.H"
#include "Function1.H"
#include "optionalDictionary.H"
#include "IOdictionary.H"
#include "vector.H"
#include "point.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- How a mesh turns as a rigid body
struct rotation
{
    //- Component along z of the unit vector of its axis
    scalar axis;

    //- Angular speed about this axis, rad/s
    autoPtr<Function1<scalar>> omega;

    //- A point of this axis, m
    point origin;
};


//- The rotation of a dynamicMeshDict, or none where the mesh moves in another
//  way or rests
std::optional<rotation> rotationOf(const dictionary& dict)
{
    const word solver(dict.lookupOrDefault<word>(
        "motionSolver", dict.lookupOrDefault<word>("solver", "none")));
    const dictionary& ofSolver = dict.optionalSubDict(solver + "Coeffs");
    // The entries of a motion have no effect on a mesh that rests
    if (dict.lookupOrDefault<word>("dynamicFvMesh", "none") == "staticFvMesh" ||
        solver != "solidBody" ||
        ofSolver.lookupOrDefault<word>("solidBodyMotionFunction", "none") !=
            "rotatingMotion")
    {
        return std::nullopt;
    }
    const dictionary& motion = ofSolver.optionalSubDict("rotatingMotionCoeffs");
    const vector axis(motion.get<vector>("axis"));
    return rotation{
        axis.z() / max(mag(axis), VSMALL),
        Function1<scalar>::New("omega", motion), motion.get<point>("origin")};
}


IOdictionary motionOf(const Time& time)
{
    return IOdictionary(optionalDictionary("dynamicMeshDict", time, false));
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::meshRotation(const Time& time)
{
    const std::optional<rotation> found(rotationOf(motionOf(time)));
    return found ? found->axis * found->omega->value(time.value()) : 0;
}


bool Foam::meshTurns(const Time& time)
{
    const std::optional<rotation> found(rotationOf(motionOf(time)));
    return found && (!isA<Function1Types::Constant<scalar>>(found->omega()) ||
                     found->axis * found->omega->value(time.value()) != 0);
}


std::optional<Foam::scalar> Foam::constantMeshRotation(const Time& time)
{
    const std::optional<rotation> found(rotationOf(motionOf(time)));
    return found && isA<Function1Types::Constant<scalar>>(found->omega())
               ? std::optional<scalar>(
                     found->axis * found->omega->value(time.value()))
               : std::nullopt;
}


void Foam::requireAxisThroughOrigin(const Time& time)
{
    const IOdictionary dict(motionOf(time));
    const std::optional<rotation> found(rotationOf(dict));
    if (found && (mag(found->origin.x()) > 0 || mag(found->origin.y()) > 0))
    {
        FatalIOErrorInFunction(dict)
            << "origin is " << found->origin << " m, but the mill turns about"
            << " the z axis; expected (0 0 0) or another point of this axis,"
            << " and a mesh around it" << exit(FatalIOError);
    }
}


// ************************************************************************* //
