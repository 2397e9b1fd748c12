/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    turningDerivative: the centripetal acceleration of a fluid on its way
    around the axis.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "turningDerivative.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * //

TEST(TurningDerivative, KeepsAFluidThatTurnsOnItsWay)
{
    const scalar omega = -3;
    const point x(0.03, -0.04, 0.2);
    const vector turning(vector(0, 0, omega) ^ x);
    // What goes along the axis or away from it does not turn
    const vector u(turning + vector(0.3, -0.4, 0.7));
    const vector found(turningDerivative::centripetal(x, u, 0.005));
    EXPECT_NEAR(found.x(), -sqr(omega) * 0.03, 1e-14);
    EXPECT_NEAR(found.y(), sqr(omega) * 0.04, 1e-14);
    EXPECT_EQ(found.z(), 0);
}


TEST(TurningDerivative, DoesNotDivideNoiseByTheDistanceFromTheAxis)
{
    const vector noise(1e-4, 2e-4, 0);
    for (const scalar r : {0.0, 1e-19, 1e-9, 1e-4})
    {
        const point x(r, 0, 0.06);
        const scalar size = 0.004;
        EXPECT_LE(
            mag(turningDerivative::centripetal(x, noise, size)),
            magSqr(noise) / size)
            << r;
    }
}


// ************************************************************************* //
