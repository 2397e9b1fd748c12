/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    surfaceTransport: a plane in a uniform flow arrives where it has to.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "fvcDiv.H"
#include "slurryShares.H"
#include "surfaceTransport.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

//- Flux of a uniform velocity, m3/s
surfaceScalarField uniformFlux(const fvMesh& mesh, const vector& U)
{
    return surfaceScalarField(
        "phi", dimensionedVector("value", dimVelocity, U) & mesh.Sf());
}

//- The share of each cell after a time-step with this flux of slurry
tmp<scalarField>
after(const volScalarField& alpha, const surfaceScalarField& slurry)
{
    return alpha.primitiveField() -
           alpha.time().deltaTValue() * fvc::div(slurry)().primitiveField();
}

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(surfaceTransport, carriesAPlaneToItsPlace)
{
    const scalar deltaT = 0.01;
    smallCase box(
        {{10, 10, 4}, {1, 1, 0.4}, skewed}, deltaT,
        "slurrySurface { fits 6; }");
    const vector n(unit(vector(0.6, 0.7, 0.1)));
    const vector U(2, 1, -0.5);
    volScalarField alpha(box.field<scalar>("alpha.slurry", dimless, 0));
    fillBelow(alpha, n, 0.6);
    const slurrySurface surface(alpha, vector::zero);
    surfaceTransport transport(surface, alpha);
    const scalarField found(after(
        alpha,
        transport.flux(
            uniformFlux(box.mesh(), U), vectorField(box.mesh().nCells(), U))));

    volScalarField expected(box.field<scalar>("expected", dimless, 0));
    fillBelow(expected, n, 0.6 + (n & U) * deltaT);
    const labelHashSet outer(atBoundary(box.mesh()));
    scalar largest = 0, moved = 0;
    forAll(found, celli)
    {
        if (!outer.found(celli))
        {
            largest = max(largest, mag(found[celli] - expected[celli]));
            moved = max(moved, mag(alpha[celli] - expected[celli]));
        }
    }
    EXPECT_GT(moved, 0.1);
    EXPECT_LT(largest, 0.02 * moved);
}

TEST(surfaceTransport, keepsTheVolumeAroundACyclicBox)
{
    const scalar deltaT = 0.02;
    smallCase box({{8, 6, 2}, {1, 1, 0.3}, skewed, true}, deltaT);
    volScalarField alpha(box.field<scalar>("alpha.slurry", dimless, 0));
    fillBelow(alpha, unit(vector(0.8, 0.5, 0.1)), 0.5);
    const slurrySurface surface(alpha, vector::zero);
    surfaceTransport transport(surface, alpha);
    // Along the lattice's x, out of the wet left end: nothing through the walls
    const vector U(-2 * skewed(vector(1, 0, 0)));
    const surfaceScalarField slurry(transport.flux(
        uniformFlux(box.mesh(), U), vectorField(box.mesh().nCells(), U)));

    const label left = box.mesh().boundaryMesh().findPatchID("left");
    const label right = box.mesh().boundaryMesh().findPatchID("right");
    EXPECT_GT(mag(sum(slurry.boundaryField()[left])), 0.01);
    forAll(slurry.boundaryField()[left], i)
    {
        EXPECT_NEAR(
            slurry.boundaryField()[left][i], -slurry.boundaryField()[right][i],
            1e-15);
    }
    const scalarField& V = box.mesh().V();
    EXPECT_NEAR(
        sum(after(alpha, slurry) * V), sum(alpha.primitiveField() * V), 1e-15);
}

TEST(surfaceTransport, inflowBringsWhatThePatchHolds)
{
    smallCase box({{4, 4, 2}, {1, 1, 0.5}});
    volScalarField alpha(
        box.field<scalar>("alpha.slurry", dimless, 0.25, "fixedValue"));
    alpha.primitiveFieldRef() = 0;
    const slurrySurface surface(alpha, vector::zero);
    surfaceTransport transport(surface, alpha);
    const vector U(0.3, 0, 0);
    const surfaceScalarField slurry(transport.flux(
        uniformFlux(box.mesh(), U), vectorField(box.mesh().nCells(), U)));

    const label left = box.mesh().boundaryMesh().findPatchID("left");
    const label right = box.mesh().boundaryMesh().findPatchID("right");
    EXPECT_NEAR(sum(slurry.boundaryField()[left]), -0.25 * 0.3 * 0.5, 1e-15);
    EXPECT_EQ(sum(slurry.boundaryField()[right]), 0);
}

// ************************************************************************* //
