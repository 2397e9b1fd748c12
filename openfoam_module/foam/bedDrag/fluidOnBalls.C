/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "fluidOnBalls.H"
#include "Time.H"
#include "averaging/files/slurry_file.hpp"

#include <algorithm>
#include <array>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(fluidOnBalls, 0);
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::addBallComponents(
    const ballForces& feel, const ballsInFlow& flow, const scalarField& alpha,
    const vectorField& U, std::vector<double>& values, const std::size_t width,
    const std::size_t first)
{
    using namespace millfoam::averaging;
    auto* cell = values.data() + first;
    forAll(alpha, celli)
    {
        const scalar w = feel.solidity[celli] + few_balls;
        const vector pressure(w * feel.pressure[celli]);
        const scalar exchange = w * feel.exchange[celli];
        const vector drag(exchange * (U[celli] - feel.velocity[celli]));
        const vector moved(w * feel.velocity[celli]);
        const scalar density = alpha[celli] * flow.slurryDensity +
                               (1 - alpha[celli]) * flow.airDensity;
        const std::array<double, ball_components> own{
            w,
            feel.solidity[celli],
            pressure.x(),
            pressure.y(),
            pressure.z(),
            exchange,
            drag.x(),
            drag.y(),
            drag.z(),
            moved.x(),
            moved.y(),
            moved.z(),
            w * density,
            w * feel.diameter[celli]};
        std::copy(own.begin(), own.end(), cell);
        cell += width;
    }
}


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
