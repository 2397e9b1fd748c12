/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshRotation.H"
#include "Function1.H"
#include "optionalDictionary.H"
#include "IOdictionary.H"
#include "vector.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::meshRotation(const Time& time)
{
    const IOdictionary dict(optionalDictionary("dynamicMeshDict", time, false));
    const word solver(dict.lookupOrDefault<word>(
        "motionSolver", dict.lookupOrDefault<word>("solver", "none")));
    const dictionary& ofSolver = dict.optionalSubDict(solver + "Coeffs");
    if (solver != "solidBody" ||
        ofSolver.lookupOrDefault<word>("solidBodyMotionFunction", "none") !=
            "rotatingMotion")
    {
        return 0;
    }
    const dictionary& motion = ofSolver.optionalSubDict("rotatingMotionCoeffs");
    const vector axis(motion.get<vector>("axis"));
    const scalar omega =
        Function1<scalar>::New("omega", motion)->value(time.value());
    return omega * axis.z() / max(mag(axis), VSMALL);
}


// ************************************************************************* //
