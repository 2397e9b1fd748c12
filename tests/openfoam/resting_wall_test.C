/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    Walls at rest on a box that turns: each face lets as much pass as it sweeps.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "fvcMeshPhi.H"
#include "restingWallVelocityFvPatchVectorField.H"
#include "smallCase.H"
#include "surfaceFields.H"

using namespace Foam;

TEST(restingWallVelocity, followsTheFaceAcrossAndRestsAlongIt)
{
    smallCase box;
    volVectorField U(box.field<vector>(
        "U", dimVelocity, vector::zero, "restingWallVelocity"));
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
