/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    movingBed of blocks, bedDrag and ballLoad in cells, compared with formulas.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "ballLoad.H"
#include "bedDrag.H"
#include "smallCase.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar solidity = 0.5;
constexpr scalar diameter = 0.005;

const string
    uniformBlock("block { box (-9 -9 -9) (9 9 9); solidity 0.5; diameter 0.005;"
                 " velocity (0.2 0 0); }");

const string fluids("slurry { rho 1239; mu 0.0014; yieldStress 0.16; }"
                    "air { rho 1.2; mu 1.8e-5; }");

//- Coefficient of a uniform bed of a law, in fluid of this share of slurry and
//  this velocity along x
scalar exchangeOf(const string& drag, const scalar alpha, const scalar U)
{
    smallCase box({{2, 2, 2}});
    const movingBed bed(entriesOf(uniformBlock), box.mesh());
    const bedDrag law(entriesOf(drag + fluids));
    return law.exchange(
        bed, box.field<scalar>("alpha.slurry", dimless, alpha),
        box.field<vector>("U", dimVelocity, vector(U, 0, 0)))()[3];
}

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(bedDrag, darcyIsErgunsViscousTerm)
{
    // beta = 150 mu phi^2/(e d^2)
    const scalar expected =
        150 * 0.0014 * sqr(solidity / diameter) / (1 - solidity);
    EXPECT_NEAR(exchangeOf("law Darcy;", 1, 0), expected, 1e-12 * expected);
}

TEST(bedDrag, isTheLawOfTheTableAtTheSlip)
{
    using namespace millfoam::drag;
    const scalar slurry = exchange_coefficient(
        find_law("Beetstra"), solidity, 0.5, diameter, {1239, 0.0014});
    const scalar air = exchange_coefficient(
        find_law("Beetstra"), solidity, 0.5, diameter, {1.2, 1.8e-5});
    const scalar half = exchangeOf("law Beetstra;", 0.5, -0.3);
    EXPECT_NEAR(exchangeOf("law Beetstra;", 1, -0.3), slurry, 1e-12 * slurry);
    EXPECT_NEAR(exchangeOf("law Beetstra;", 0, -0.3), air, 1e-12 * air);
    EXPECT_NEAR(half, (slurry + air) / 2, 1e-12 * slurry);
    EXPECT_NEAR(
        exchangeOf("law Beetstra; multiplier 3;", 1, -0.3), 3 * slurry,
        1e-11 * slurry);
    // Of equal balls the factor of the sizes is 1 + 0.064 e
    EXPECT_NEAR(
        exchangeOf("law Beetstra; polydispersity yes;", 1, -0.3),
        1.032 * slurry, 1e-11 * slurry);
}

TEST(bedDrag, stopsWhereTheLawWouldDriveTheFluid)
{
    // Re = 1239*0.35*2.9*0.005/0.0014 v: 4490 at 2.9 m/s, 26300 at 17 m/s
    const string dense("block { box (-9 -9 -9) (9 9 9); solidity 0.65;"
                       " diameter 0.005; velocity (0 0 0); }");
    const auto errorAt = [&](const string& law, const scalar U)
    {
        smallCase box({{2, 2, 2}});
        const movingBed bed(entriesOf(dense), box.mesh());
        const bedDrag drag(entriesOf(law + fluids));
        return errorOf(
            [&]
            {
                drag.exchange(
                    bed, box.field<scalar>("alpha.slurry", dimless, 1),
                    box.field<vector>("U", dimVelocity, vector(U, 0, 0)));
            });
    };
    EXPECT_EQ(errorAt("law Tang;", 2.9), "");
    EXPECT_EQ(errorAt("law Ergun;", 17), "");
    const std::string error = errorAt("law Tang;", 17);
    for (const char* word :
         {"Tang is negative", "solidity 0.65", "Re 26328", "another law"})
    {
        EXPECT_NE(error.find(word), std::string::npos) << error;
    }
}

TEST(bedDrag, ofAnyShapeHasTheBallsSphericities)
{
    const string law("law HoelzerSommerfeld;");
    const scalar expected = millfoam::drag::exchange_coefficient(
        millfoam::drag::Shape{0.9, 0.8}, solidity, 0.5, diameter,
        {1239, 0.0014});
    EXPECT_NEAR(
        exchangeOf(law + " shapes ((1 0.9 0.8));", 1, -0.3), expected,
        1e-12 * expected);
    // Without shapes the balls are spheres
    const scalar spheres = exchangeOf(law, 1, -0.3);
    EXPECT_LT(spheres, expected);
    EXPECT_NEAR(
        exchangeOf(law + " shapes ((0.75 1 1) (0.25 0.9 0.8));", 1, -0.3),
        0.75 * spheres + 0.25 * expected, 1e-12 * expected);
    // The other laws are those of spheres
    const scalar beetstra = exchangeOf("law Beetstra;", 1, -0.3);
    EXPECT_DOUBLE_EQ(
        exchangeOf("law Beetstra; shapes ((1 0.9 0.9));", 1, -0.3), beetstra);
}

TEST(bedDrag, sharesItsResistanceByRelativePermeabilities)
{
    const auto found = [](const scalar alpha)
    { return exchangeOf("law Hill; mixed permeability;", alpha, -0.3); };
    const scalar slurry = found(1);
    const scalar air = found(0);
    EXPECT_NEAR(slurry, exchangeOf("law Hill;", 1, -0.3), 1e-12 * slurry);
    EXPECT_NEAR(air, exchangeOf("law Hill;", 0, -0.3), 1e-12 * air);
    const scalar expected = 1 / (0.512 / slurry + 0.008 / air);
    EXPECT_NEAR(found(0.8), expected, 1e-12 * expected);
    EXPECT_EQ(
        exchangeOf("law Hill; mixed permeability; multiplier 0;", 0.8, -0.3),
        0);
}

TEST(bedDrag, poreViscosityIsCappedWhereNothingMoves)
{
    const scalar plastic = exchangeOf("law Darcy;", 1, 0.2);
    EXPECT_NEAR(
        exchangeOf("law Darcy; viscosity pore;", 1, 0.2), 1000 * plastic,
        1e-9 * plastic);
    const scalar moving = exchangeOf("law Darcy; viscosity pore;", 1, -5);
    EXPECT_GT(moving, plastic);
    EXPECT_LT(moving, 1.5 * plastic);
}

TEST(bedDrag, refusesALawThatNobodyPublished)
{
    const std::string error = errorOf([] { exchangeOf("law Nobody;", 1, 0); });
    EXPECT_NE(error.find("Nobody"), std::string::npos) << error;
    EXPECT_NE(error.find("Beetstra"), std::string::npos) << error;
}

TEST(bedDrag, refusesShapesThatAreNotPossible)
{
    const auto refusal = [](const string& shapes)
    {
        return errorOf(
            [&] {
                exchangeOf(
                    "law HoelzerSommerfeld; shapes " + shapes + ";", 1, 0);
            });
    };
    for (const auto& [shapes, words] :
         {std::pair("((0.5 1 1) (0.4 0.9 0.9))", "add up to 0.9; expected 1"),
          std::pair("((1 1.1 1))", "sphericity above 0 and up to 1"),
          std::pair("((1 0.9 0))", "crosswise sphericity above 0"),
          std::pair("((1.5 1 1) (-0.5 1 1))", "volume of 0 or above"),
          std::pair("(1 0.9 0.9)", "shapes has 1 where a vector begins")})
    {
        const std::string error = refusal(shapes);
        EXPECT_NE(error.find(words), std::string::npos) << error;
    }
}

TEST(bedDrag, aBallFeelsTheTablesCoefficientOverItsVolume)
{
    using namespace millfoam::drag;
    const Law& law = find_law("Beetstra");
    const Fluid slurry{1239, 0.0014}, air{1.2, 1.8e-5};
    // Balls on the left, few in the middle, none on the right
    smallCase box({{3, 1, 1}, {3, 1, 1}});
    const movingBed bed(
        entriesOf("blocks {"
                  " a { box (0 -9 -9) (1 9 9); solidity 0.5; diameter 0.005;"
                  " velocity (0.2 0 0); }"
                  " b { box (1 -9 -9) (2 9 9); solidity 1e-4; diameter 0.008;"
                  " velocity (0.2 0 0); } }"),
        box.mesh());
    const scalar whole = (0.5 + 1e-4) / (0.5 / 0.005 + 1e-4 / 0.008);
    const scalarField d(bed.diameterOfBalls());
    EXPECT_NEAR(d[0], 0.005, 1e-15);
    EXPECT_NEAR(d[1], 0.008, 1e-15);
    EXPECT_NEAR(d[2], whole, 1e-15);

    for (const char* entries :
         {"law Beetstra; multiplier 3;",
          "law Beetstra; multiplier 3; polydispersity yes;"})
    {
        const bedDrag drag(entriesOf(string(entries) + fluids));
        const auto found = [&](const scalar alpha)
        {
            return scalarField(drag.ballExchange(
                bed, box.field<scalar>("alpha.slurry", dimless, alpha),
                box.field<vector>("U", dimVelocity, vector(-0.3, 0, 0))));
        };
        const auto expected = [&](const scalar phi, const scalar slip,
                                  const scalar size, const Fluid& fluid)
        { return 3 * exchange_coefficient(law, phi, slip, size, fluid) / phi; };
        const scalarField wet(found(1)), dry(found(0)), half(found(0.5));
        EXPECT_NEAR(wet[0] / expected(0.5, 0.5, 0.005, slurry), 1, 1e-12);
        EXPECT_NEAR(dry[0] / expected(0.5, 0.5, 0.005, air), 1, 1e-12);
        EXPECT_NEAR(half[0] / (wet[0] + dry[0]), 0.5, 1e-12);
        EXPECT_NEAR(wet[1] / expected(1e-3, 0.5, 0.008, slurry), 1, 1e-12);
        // A ball at rest
        EXPECT_NEAR(wet[2] / expected(1e-3, 0.3, whole, slurry), 1, 1e-12);
    }
}

TEST(bedDrag, withoutAnyBallsTheyFeelNothing)
{
    smallCase box({{2, 2, 2}});
    const movingBed bed(
        entriesOf("block { box (5 5 5) (6 6 6); solidity 0.5; diameter 0.005;"
                  " velocity (0 0 0); } ledgerCorrection no;"),
        box.mesh());
    const bedDrag drag(entriesOf("law Hill;" + fluids));
    const scalarField found(drag.ballExchange(
        bed, box.field<scalar>("alpha.slurry", dimless, 1),
        box.field<vector>("U", dimVelocity, vector(1, 0, 0))));
    EXPECT_EQ(max(mag(found)), 0);
    EXPECT_EQ(max(mag(bed.diameterOfBalls())), 0);
}

TEST(movingBed, aBlockKeepsItsVolumeWhereverItMoves)
{
    smallCase box({{16, 8, 4}, {1, 0.5, 0.25}}, 0.013);
    movingBed bed(
        entriesOf("block { box (0.11 0.13 0.01) (0.42 0.31 0.2);"
                  " solidity 0.5; diameter 0.005; velocity (1 0.3 0);"
                  " moves yes; } ledgerCorrection no;"),
        box.mesh());
    const scalar volume = 0.5 * 0.31 * 0.18 * 0.19;
    const scalarField& V = box.mesh().V();
    for (label step = 0; step < 20; ++step)
    {
        EXPECT_NEAR(sum(bed.solidity().primitiveField() * V), volume, 1e-15);
        ++box.time();
        bed.update();
    }
    // 20 steps on it is where its velocity has brought it, spread over the
    // cells that it cuts; a direction of the centre depends on it alone
    const vector centre(
        sum(bed.solidity().primitiveField() * V *
            box.mesh().C().primitiveField()) /
        volume);
    const auto spread = [](const scalar from, const scalar to)
    {
        const scalar h = 1.0 / 16;
        scalar moment = 0;
        for (label i = 0; i < 16; ++i)
        {
            const scalar overlap = min(to, (i + 1) * h) - max(from, i * h);
            moment += max(overlap, 0) * (i + 0.5) * h;
        }
        return moment / (to - from);
    };
    const scalar moved = 20 * 0.013;
    EXPECT_NEAR(centre.x(), spread(0.11 + moved, 0.42 + moved), 1e-12);
    EXPECT_NEAR(
        centre.y(), spread(0.13 + 0.3 * moved, 0.31 + 0.3 * moved), 1e-12);
    EXPECT_NEAR(centre.z(), spread(0.01, 0.2), 1e-12);
}

TEST(movingBed, aBlockMixesByVolumeNotByVelocity)
{
    // Two blocks in one place: solidities add, velocity by momentum, d32 by
    // surface
    smallCase box({{2, 2, 2}});
    const movingBed bed(
        entriesOf("blocks {"
                  " a { box (-9 -9 -9) (9 9 9); solidity 0.3; diameter 0.004;"
                  " velocity (1 0 0); }"
                  " b { box (-9 -9 -9) (9 9 9); solidity 0.1; diameter 0.008;"
                  " velocity (0 2 0); } }"),
        box.mesh());
    EXPECT_NEAR(bed.solidity()[0], 0.4, 1e-15);
    EXPECT_NEAR(bed.voidage()[0], 0.6, 1e-15);
    EXPECT_LT(mag(bed.velocity()[0] - vector(0.75, 0.5, 0)), 1e-14);
    EXPECT_NEAR(bed.diameter()[0], 0.4 / (0.3 / 0.004 + 0.1 / 0.008), 1e-15);
    EXPECT_NEAR(bed.diameter43()[0], (0.3 * 0.004 + 0.1 * 0.008) / 0.4, 1e-15);
}

TEST(movingBed, theVoidageBeforeIsThatOfTheOldTimeInTheNewCells)
{
    smallCase box({{16, 4, 2}, {1, 0.25, 0.125}}, 0.1);
    movingBed bed(
        entriesOf("block { box (0.25 -9 -9) (0.5 9 9); solidity 0.4;"
                  " diameter 0.005; velocity (0.625 0 0); moves yes; }"
                  " ledgerCorrection no;"),
        box.mesh());
    const scalarField start(bed.voidage().primitiveField());
    ++box.time();
    // The mesh goes with the block, one cell on: there the voidage is as ever
    box.mesh().movePoints(box.mesh().points() + vector(0.0625, 0, 0));
    const scalarField before(bed.voidageBefore()().field());
    bed.update();

    forAll(start, celli)
    {
        EXPECT_NEAR(bed.voidage()[celli], start[celli], 1e-12);
        const bool last = celli % 16 == 15;
        EXPECT_NEAR(before[celli], last ? 1 : start[celli + 1], 1e-12);
    }
}

TEST(ballLoad, aBallInRestingSlurryFeelsItsBuoyancy)
{
    smallCase box({{2, 2, 2}});
    const movingBed bed(entriesOf(uniformBlock), box.mesh());
    ballLoad load(entriesOf("ballDensity 2700;"), bed, gravity);
    const scalar slurry = 1239;
    // At rest -grad p is -rho g
    const vectorField atRest(box.mesh().nCells(), -slurry * gravity);
    load.update(
        atRest, box.field<scalar>("beta", dimDensity / dimTime, 0),
        box.field<vector>("U", dimVelocity, vector(0.2, 0, 0)));
    EXPECT_NEAR(load.mean(), slurry / 2700, 1e-12);
    EXPECT_NEAR(load.high(), slurry / 2700, 1e-12);

    // In fluid that falls freely there is the drag alone, with its share of the
    // pressure's slope
    const scalar beta = 500, slip = 0.1;
    load.update(
        vectorField(
            box.mesh().nCells(), vector(beta * slip / (1 - solidity), 0, 0)),
        box.field<scalar>("beta", dimDensity / dimTime, beta),
        box.field<vector>("U", dimVelocity, vector(0.2 + slip, 0, 0)));
    EXPECT_NEAR(
        load.mean(), beta * slip / (1 - solidity) / (solidity * 2700 * 9.81),
        1e-12);
}

// ************************************************************************* //
