/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    Walls at rest on a box that turns: each face lets as much pass as it sweeps,
    and an inlet lets its rate more pass.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "fvcMeshPhi.H"
#include "restingWallVelocityFvPatchVectorField.H"
#include "smallCase.H"
#include "superficialInletVelocityFvPatchVectorField.H"
#include "surfaceFields.H"

using namespace Foam;

//- Turn a box about z in a time-step
static void turn(smallCase& box)
{
    ++box.time();
    pointField points(box.mesh().points());
    const scalar angle = 0.02;
    for (point& p : points)
    {
        p = point(
            p.x() * Foam::cos(angle) - p.y() * Foam::sin(angle),
            p.x() * Foam::sin(angle) + p.y() * Foam::cos(angle), p.z());
    }
    box.mesh().movePoints(points);
}

TEST(restingWallVelocity, followsTheFaceAcrossAndRestsAlongIt)
{
    smallCase box;
    volVectorField U(box.field<vector>(
        "U", dimVelocity, vector::zero, "restingWallVelocity"));
    turn(box);
    U.correctBoundaryConditions();

    const surfaceScalarField swept(fvc::meshPhi(U));
    scalar largest = 0;
    forAll(box.mesh().boundary(), patchi)
    {
        const fvPatch& patch = box.mesh().boundary()[patchi];
        const vectorField& velocity = U.boundaryField()[patchi];
        const scalarField& sweep = swept.boundaryField()[patchi];
        const vectorField normal(patch.nf());
        forAll(velocity, facei)
        {
            const scalar through = velocity[facei] & patch.Sf()[facei];
            const vector along =
                velocity[facei] -
                normal[facei] * (normal[facei] & velocity[facei]);
            EXPECT_NEAR(through, sweep[facei], 1e-15);
            EXPECT_NEAR(mag(along), 0, 1e-15);
            largest = max(largest, mag(sweep[facei]));
        }
    }
    // Its sides are not round, so that they do sweep
    EXPECT_GT(largest, 1e-4);
}

TEST(superficialInletVelocity, keepsItsRateWhereThePatchMoves)
{
    smallCase box;
    const scalar rate = 0.03;
    volVectorField U(
        IOobject("U", box.time().timeName(), box.mesh()), box.mesh(),
        entriesOf("dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 0);"
                  "boundaryField { \".*\" { type noSlip; } bottom { type"
                  " superficialInletVelocity; volumetricFlowRate 0.03; } }"));
    turn(box);
    U.correctBoundaryConditions();
    const label bottom = box.mesh().boundaryMesh().findPatchID("bottom");
    const surfaceScalarField phi(fvc::meshPhi(U));
    const scalarField& swept = phi.boundaryField()[bottom];
    const scalarField passing(
        (U.boundaryField()[bottom] & box.mesh().boundary()[bottom].Sf()) -
        swept);
    EXPECT_GT(mag(sum(swept)), 0.1 * rate);
    EXPECT_NEAR(sum(passing), -rate, 1e-14);
    EXPECT_NEAR(max(passing), min(passing), 1e-14);
}

TEST(restingWallVelocity, isAtRestWhereTheMeshIs)
{
    smallCase box;
    volVectorField U(box.field<vector>(
        "U", dimVelocity, vector::one, "restingWallVelocity"));
    ++box.time();
    U.correctBoundaryConditions();
    forAll(box.mesh().boundary(), patchi)
    {
        EXPECT_EQ(gSumMag(U.boundaryField()[patchi]), 0);
    }
}

// ************************************************************************* //
