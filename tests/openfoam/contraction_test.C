/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    voidageContraction: flow along x through a bed whose voidage varies along x.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "smallCase.H"
#include "surfaceInterpolate.H"
#include "voidageContraction.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar fluidDensity = 1239;
constexpr scalar bedStep = 0.01;

//- Superficial velocity along x, m/s
constexpr scalar q = 0.3;

//- A row of cells through a bed with soft edges
class bedCase : public smallCase
{
    public:
    movingBed bed;
    volVectorField U;
    surfaceScalarField flux;
    surfaceScalarField faceDensity;
    voidageContraction contraction;

    explicit bedCase(const string& velocity)
    : smallCase({{16, 2, 2}, {1, 0.25, 0.25}}, bedStep),
      bed(entriesOf(
              "block { box (0.2 -9 -9) (0.9 9 9); edge 0.3; edgeAxes (1 0 0);"
              " solidity 0.5; diameter 0.005; velocity " +
              velocity + "; }"),
          mesh()),
      U(field<vector>("U", dimVelocity, vector::zero)),
      flux(
          "rhoPhi", dimensionedVector(
                        "flux", dimDensity * dimVelocity,
                        vector(fluidDensity * q, 0, 0)) &
                        mesh().Sf()),
      faceDensity(
          IOobject("faceDensity", time().timeName(), mesh()), mesh(),
          dimensionedScalar("rho", dimDensity, fluidDensity)),
      contraction(bed, bed.voidage(), U)
    {
        forAll(U, celli)
        {
            U[celli] = vector(q / bed.voidage()[celli], 0, 0);
        }
        U.correctBoundaryConditions();
    }
};

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(voidageContraction, ofABedAtRestIsAllAtTheFaces)
{
    // Each cell sends and gets q/e at its own e: the rest is the faces' part
    bedCase box("(0 0 0)");
    EXPECT_LT(min(box.bed.voidage()).value(), 0.51);
    EXPECT_LT(
        max(mag(box.contraction.convection(box.flux)().primitiveField())),
        1e-9);
}

TEST(voidageContraction, addsUpToBernoullisPressure)
{
    bedCase box("(0 0 0)");
    const surfaceScalarField found(
        box.contraction.contractionFlux(box.flux, box.faceDensity));
    const surfaceScalarField inverse(fvc::interpolate(1 / box.bed.voidage()));
    const fvMesh& mesh = box.mesh();
    // Along the first row up to the middle of the bed: the pressure that keeps
    // the flux is found/(dt e_f S) dx rho, and falls by rho (u2^2 - u1^2)/2
    scalar fall = 0;
    forAll(mesh.neighbour(), facei)
    {
        const label own = mesh.owner()[facei];
        if (mesh.neighbour()[facei] == own + 1 && own < 8)
        {
            fall -= fluidDensity * found[facei] * inverse[facei] /
                    (bedStep * mesh.magSf()[facei]) / 16;
        }
    }
    const scalar expected =
        fluidDensity / 2 * (magSqr(box.U[8]) - magSqr(box.U[0]));
    EXPECT_GT(expected, 100);
    EXPECT_NEAR(fall, expected, 1e-9 * expected);
}

TEST(voidageContraction, isNoneWhereBallsMoveAlong)
{
    bedCase box("(0.4 0 0)");
    box.U = dimensionedVector("U", dimVelocity, vector(0.4, 0, 0));
    const surfaceScalarField found(
        box.contraction.contractionFlux(box.flux, box.faceDensity));
    EXPECT_LT(max(mag(found)).value(), 1e-15);

    // A tenth faster there is some
    box.U *= 1.1;
    EXPECT_GT(
        max(mag(box.contraction.contractionFlux(box.flux, box.faceDensity)()))
            .value(),
        1e-6);
}

TEST(voidageContraction, withoutABedIsPlainConvection)
{
    smallCase box({{8, 2, 2}});
    const movingBed bed(dictionary::null, box.mesh());
    volVectorField U(box.field<vector>("U", dimVelocity, vector::zero));
    forAll(U, celli)
    {
        U[celli] = vector(2 * box.mesh().C()[celli].x(), 0, 0);
    }
    U.correctBoundaryConditions();
    const volScalarField voidage(box.field<scalar>("voidage", dimless, 1));
    const surfaceScalarField flux(
        "rhoPhi",
        dimensionedVector(
            "flux", dimDensity * dimVelocity, vector(fluidDensity * q, 0, 0)) &
            box.mesh().Sf());
    const volVectorField found(
        voidageContraction(bed, voidage, U).convection(flux));
    // rho q dU/dx inside
    EXPECT_NEAR(found[3].x(), 2 * fluidDensity * q, 1e-9);
}

// ************************************************************************* //
