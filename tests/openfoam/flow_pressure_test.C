/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    flowPressure: fluxes that conserve volume, between pressures and in closed boxes.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include <memory>

#include "fixedFluxPressureFvPatchScalarField.H"
#include "flowPressure.H"
#include "fvcDiv.H"
#include "smallCase.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar solutionStep = 0.1;
constexpr scalar mobility = 0.002;

//- A box of slurry without gravity, and the solution for its pressure
class solutionCase : public smallCase
{
    public:
    volScalarField alpha;
    volScalarField p_rgh;
    slurrySurface surface;
    sharpPressure force;
    millfoam::record::StageClock clock;
    flowPressure solution;
    pimpleControl pimple;
    surfaceScalarField free;
    surfaceScalarField mobilities;
    volScalarField::Internal room;

    //- ends: type of p_rgh at left and right
    solutionCase(const smallBox& shape, const word& ends)
    : smallCase(
          shape, solutionStep,
          "solvers { \"p_rgh.*\" { solver PCG; preconditioner DIC;"
          " tolerance 1e-16; relTol 0; maxIter 2000; } }"
          "PIMPLE { nNonOrthogonalCorrectors 12; }"),
      alpha(field<scalar>("alpha.slurry", dimless, 1)),
      p_rgh(
          IOobject("p_rgh", time().timeName(), mesh()), mesh(),
          dimensionedScalar(dimPressure, Zero), patchTypes(ends)),
      surface(alpha, vector::zero),
      force(
          surface, p_rgh, dimensionedVector(dimAcceleration, Zero),
          dimensionedScalar("rho", dimDensity, 1239),
          dimensionedScalar("rho", dimDensity, 1.2),
          dimensionedScalar("sigma", dimForce / dimLength, 0)),
      solution(p_rgh, force, true, clock),
      pimple(mesh()),
      free(faces("free", dimVolume / dimTime, 0)),
      mobilities(faces("mobility", dimVolume * dimTime / dimMass, mobility)),
      room(
          IOobject("room", time().timeName(), mesh()), mesh(),
          dimensionedScalar(dimless / dimTime, Zero))
    {
    }

    static wordList patchTypes(const word& ends)
    {
        wordList result(6, fixedFluxPressureFvPatchScalarField::typeName);
        result[0] = result[1] = ends;
        return result;
    }

    surfaceScalarField
    faces(const word& name, const dimensionSet& dimensions, const scalar value)
    {
        return surfaceScalarField(
            IOobject(name, time().timeName(), mesh()), mesh(),
            dimensionedScalar("value", dimensions, value));
    }

    //- The flux, without any through walls
    tmp<surfaceScalarField> flux()
    {
        const surfaceScalarField none(faces("none", dimVolume / dimTime, 0));
        return solution.flux(
            free, mobilities, room, none.boundaryField(), pimple);
    }
};

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(flowPressure, drivesFluidFromHighToLow)
{
    solutionCase box({{8, 3, 3}, {2, 1, 1}}, "fixedValue");
    box.p_rgh.boundaryFieldRef()[0] == 100;
    const surfaceScalarField flux(box.flux());

    // 50 Pa/m along x
    const surfaceScalarField expected(
        dimensionedVector("U", dimVelocity, vector(50 * mobility, 0, 0)) &
        box.mesh().Sf());
    EXPECT_LT(max(mag(flux - expected)).value(), 1e-12);
    EXPECT_NEAR(box.p_rgh[3], 100 * (1 - 3.5 / 8), 1e-9);
    EXPECT_EQ(box.solution.withoutRoom(), 0);
}

TEST(flowPressure, fillsTheRoomThatCellsGet)
{
    solutionCase box({{6, 5, 3}, {1, 1, 0.4}, skewed}, "fixedFluxPressure");
    forAll(box.room, celli)
    {
        box.room[celli] = std::sin(celli);
    }
    const scalarField& V = box.mesh().V();
    const scalarField asked(box.room.field());
    const scalar mean = sum(asked * V) / sum(V);
    const surfaceScalarField flux(box.flux());

    EXPECT_GT(mag(mean), 1e-4);
    // Cells get more room than there is fluid for
    EXPECT_NEAR(
        box.solution.withoutRoom(), -mean * sum(V) * solutionStep, 1e-14);
    EXPECT_LT(max(mag(fvc::div(flux)().primitiveField() + asked - mean)), 1e-9);
    for (const fvsPatchScalarField& patch : flux.boundaryField())
    {
        EXPECT_LT(max(mag(patch)), 1e-12);
    }
}

TEST(flowPressure, countsAFeedThatAClosedBoxHasNoRoomFor)
{
    solutionCase box({{6, 5, 3}}, "fixedFluxPressure");
    surfaceScalarField walls(box.faces("walls", dimVolume / dimTime, 0));
    walls.boundaryFieldRef()[2] = -1e-4; // 18 faces of the bottom
    box.solution.flux(
        box.free, box.mobilities, box.room, walls.boundaryField(), box.pimple);
    EXPECT_NEAR(box.solution.withoutRoom(), 18e-4 * solutionStep, 1e-15);
}

TEST(flowPressure, countsTheIterationsOfATimeStep)
{
    solutionCase box({{6, 5, 3}}, "fixedValue");
    box.p_rgh.boundaryFieldRef()[0] == 100;
    box.flux();
    EXPECT_GT(box.solution.iterations(), 1);
    EXPECT_LT(box.solution.residual(), 1e-12);
    box.solution.begin();
    EXPECT_EQ(box.solution.iterations(), 0);
}

// ************************************************************************* //
