/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "fluidOnBalls.H"
#include "Time.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(fluidOnBalls, 0);
} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::fluidOnBalls::fluidOnBalls(
    const fvMesh& mesh, const ballsInFlow& flow,
    const std::function<ballForces()>& compute)
: regIOobject(IOobject(typeName, mesh.time().constant(), mesh)),
  flow_(flow),
  compute_(compute)
{
}


// ************************************************************************* //
