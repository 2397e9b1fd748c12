/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    solidsConservation: the known volume, and no cell above the bound.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "smallCase.H"
#include "solidsConservation.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

string noAdvice()
{
    return "Advice. ";
}

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(solidsConservation, scalesAllCellsByOneFactorBelowTheBound)
{
    const dictionary dict(entriesOf("largestCorrection 0.1;"));
    solidsConservation conservation(dict);
    scalarField solidity(scalarList{0.5, 0.3, 0});
    conservation.correct(
        solidity, scalarField(scalarList{1, 2, 4}), 1.155, noAdvice);

    EXPECT_NEAR(solidity[0], 0.525, 1e-14);
    EXPECT_NEAR(solidity[1], 0.315, 1e-14);
    EXPECT_EQ(solidity[2], 0);
    EXPECT_NEAR(conservation.present(), 0.05, 1e-14);
    EXPECT_NEAR(conservation.moved(), 0, 1e-14);
}

TEST(solidsConservation, movesWhatFullCellsCannotTake)
{
    const dictionary dict(entriesOf("largestSolidity 0.6;"));
    solidsConservation conservation(dict);
    scalarField solidity(scalarList{0.8, 0.2});
    conservation.correct(solidity, scalarField(scalarList{1, 1}), 1, noAdvice);

    EXPECT_NEAR(solidity[0], 0.6, 1e-14);
    EXPECT_NEAR(solidity[1], 0.4, 1e-13);
    // The factor is 2: of 1.6 m3 in the first cell 0.6 stay
    EXPECT_NEAR(conservation.moved(), 1, 1e-12);
    EXPECT_EQ(conservation.present(), 0);
}

TEST(solidsConservation, givesTheVolumeOfManyCellsToRoundOff)
{
    const dictionary dict(
        entriesOf("largestSolidity 0.62; largestCorrection 0.1;"));
    solidsConservation conservation(dict);
    scalarField solidity(1000), V(1000);
    forAll(solidity, celli)
    {
        solidity[celli] = 0.6 * mag(std::sin(0.37 * celli));
        V[celli] = 1e-6 * (1.5 + std::cos(1.3 * celli));
    }
    const scalar volume = 1.08 * sum(solidity * V);
    conservation.correct(solidity, V, volume, noAdvice);

    EXPECT_NEAR(sum(solidity * V), volume, 1e-12 * volume);
    EXPECT_LE(max(solidity), 0.62);
    EXPECT_GT(conservation.moved(), 0);
}

TEST(solidsConservation, refusesALargeCorrectionWithTheAdvice)
{
    const dictionary dict(entriesOf("largestCorrection 0.02;"));
    solidsConservation conservation(dict);
    scalarField solidity(scalarList{0.5});
    const std::string error = errorOf(
        [&]
        {
            conservation.correct(
                solidity, scalarField(scalarList{1}), 0.52, noAdvice);
        });
    EXPECT_NE(error.find("would be 4 %"), std::string::npos) << error;
    EXPECT_NE(error.find("Advice."), std::string::npos) << error;
    EXPECT_EQ(solidity[0], 0.5);
}

TEST(solidsConservation, refusesAVolumeThatFullCellsCannotHold)
{
    const dictionary dict(
        entriesOf("largestSolidity 0.5; largestCorrection 1;"));
    solidsConservation conservation(dict);
    scalarField solidity(scalarList{0.4});
    const std::string error = errorOf(
        [&] {
            conservation.correct(
                solidity, scalarField(scalarList{1}), 0.6, noAdvice);
        });
    EXPECT_NE(error.find("have no room"), std::string::npos) << error;
}

// ************************************************************************* //
