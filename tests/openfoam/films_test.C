/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    surfaceFilms: what of the slurry that makes no cell wet has a level, and
    what falls.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "slurryShares.H"
#include "slurrySurface.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

//- A floor that falls by 0.1 over the length
point sloped(const point& p)
{
    return {p.x(), p.y() - 0.1 * p.x(), p.z()};
}

//- Slurry at rest in a box
struct filmCase : smallCase
{
    volScalarField alpha;

    explicit filmCase(const smallBox& box)
    : smallCase(box),
      alpha(field<scalar>("alpha.slurry", dimless, 0))
    {
    }

    //- Slurry of all cells of one volume, in volumes of a cell, that is drops
    scalar drops() const
    {
        const slurrySurface surface(alpha, gravity);
        return gSum((surface.films().loose() * alpha)().primitiveField());
    }
};

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(surfaceFilms, theThinEdgeOfAPoolIsAFilmWithOneLevel)
{
    // Cells of 0.2 are covered by less than a half from the left end to 0.5
    filmCase box({{20, 5, 1}, {1, 1, 0.05}, sloped, false, "empty"});
    fillBelow(box.alpha, vector(0, 1, 0), 0.05);
    const slurrySurface surface(box.alpha, gravity);

    const surfaceFilms& films = surface.films();
    label thin = 0;
    forAll(box.alpha, celli)
    {
        if (box.alpha[celli] > 0 && films.film()[celli] > 0)
        {
            EXPECT_DOUBLE_EQ(films.film()[celli], 1);
            ++thin;
        }
    }
    EXPECT_GT(thin, 5);
    EXPECT_LT(box.drops(), 1e-12);
    EXPECT_LT(gMax(mag(films.rise()().primitiveField())), 1e-14);
}

TEST(surfaceFilms, aStepOfAFilmIsTheRiseOfItsLevel)
{
    filmCase box(
        {{2, 4, 1},
         {1, 1, 0.5},
         [](const point& p) { return p; },
         true,
         "empty"});
    box.alpha[0] = 0.3;
    box.alpha[1] = 0.35;
    box.alpha.correctBoundaryConditions();

    const slurrySurface surface(box.alpha, gravity);
    const surfaceScalarField rise(surface.films().rise());
    forAll(box.mesh().neighbour(), facei)
    {
        // Cells of 0.25; the other faces have air on at least one side
        const bool floor = box.mesh().neighbour()[facei] == 1;
        EXPECT_NEAR(rise[facei], floor ? 0.05 * 0.25 : 0, 1e-15);
    }
    // Beyond the cyclic pair, left and right, lie the same two cells
    EXPECT_NEAR(rise.boundaryField()[0][0], 0.05 * 0.25, 1e-15);
    EXPECT_NEAR(rise.boundaryField()[1][0], -0.05 * 0.25, 1e-15);
}

TEST(surfaceFilms, whatHangsInTheAirOrOnASteepWallIsDrops)
{
    filmCase box({{8, 8, 1}, {1, 1, 0.125}});
    box.alpha = dimensionedScalar(dimless, Zero);
    const scalar layer = 8 * 0.3;
    // A level layer in the air, then one on a wall to the left
    for (label i = 0; i < 8; ++i)
    {
        box.alpha[8 * 5 + i] = 0.3;
    }
    EXPECT_NEAR(box.drops(), layer, 1e-12);
    box.alpha = dimensionedScalar(dimless, Zero);
    for (label i = 0; i < 8; ++i)
    {
        box.alpha[8 * i] = 0.3;
    }
    EXPECT_NEAR(box.drops(), layer, 1e-12);
}


// ************************************************************************* //
