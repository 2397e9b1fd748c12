/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    solidsContinuity of beds in a box whose residual is known.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "smallCase.H"
#include "solidsContinuity.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

//- Continuity of a uniform bed of solidity 0.5 that moves along x with 0.2 m/s,
//  with this rate, between walls that move with the speed along x
solidsContinuity continuityOf(
    smallCase& box, const movingBed& bed,
    const std::function<scalar(const point&)>& rate, const scalar wallSpeed)
{
    volScalarField given(box.field<scalar>("rate", dimless / dimTime, 0.));
    forAll(given, celli)
    {
        given[celli] = rate(box.mesh().C()[celli]);
    }
    volVectorField U(box.field<vector>("U", dimVelocity, vector(0.5, 0, 0)));
    for (fvPatchVectorField& patch : U.boundaryFieldRef())
    {
        patch == vector(wallSpeed, 0, 0);
    }
    solidsContinuity result(bed);
    result.update(
        given.internalField(),
        box.field<scalar>("alpha.slurry", dimless, scalar(1)), U,
        entriesOf(
            "solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0;"));
    return result;
}

const string
    block("block { box (-9 -9 -9) (9 9 9); solidity 0.5; diameter 0.005;"
          " velocity (0.2 0 0); }");

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(solidsContinuity, ofABedThatMovesWithItsWallsIsZero)
{
    smallCase box;
    const movingBed bed(entriesOf(block), box.mesh());
    const solidsContinuity found = continuityOf(
        box, bed, [](const point&) { return 0; }, 0.2);
    EXPECT_NEAR(found.residual(), 0, 1e-14);
    EXPECT_NEAR(found.driven(), 0, 1e-12);
    EXPECT_NEAR(found.slip(), 0.3, 1e-12);
}

TEST(solidsContinuity, drivesTheFlowThatMakesRoom)
{
    // R = k sin(k x) A drives the superficial velocity A (1 - cos(k x)) along x
    // between the walls of a box of length 1, with k = 2 pi
    smallCase box({{64, 2, 2}});
    const movingBed bed(entriesOf(block), box.mesh());
    const scalar k = 2 * constant::mathematical::pi;
    const scalar A = 0.01;
    const solidsContinuity found = continuityOf(
        box, bed, [&](const point& p) { return A * k * std::sin(k * p.x()); },
        0.2);
    EXPECT_NEAR(found.residual(), A * k / std::sqrt(2.), 1e-4 * A * k);
    EXPECT_NEAR(found.driven(), A / 0.5 * std::sqrt(1.5), 1e-3 * A);
}

// ************************************************************************* //
