/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    solidsClock and solidsRecord: a solids.h5 of three windows, whose lengths
    are 0.1, 0.2 and 0.1 s of DEM time from 2 s on, written here.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "movingBed.H"
#include "smallCase.H"
#include "solidsWindow.H"
#include "solidsClock.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

//- Solidity of a voxel of a window: linear in x, so that linear interpolation
//  is exact between the voxels' middles
scalar solidityAt(const label window, const scalar x)
{
    return 0.1 + 0.1 * window + 0.05 * x;
}

//- Write the file: voxels of 0.25 m in a box of twice the unit cube's edge
//  around its middle; velocity (window 0 1), balls of 10 mm
void writeSolids(const std::filesystem::path& path)
{
    using namespace millfoam::averaging;
    const BoxGrid grid({-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}, {8, 8, 8});
    SolidsHeader header;
    header.time0 = 2;
    header.timestep = 1e-5;
    SolidsWriter writer(path, grid, header);
    const double ends[] = {2, 2.1, 2.3, 2.4};
    for (int i = 0; i < 3; ++i)
    {
        WindowAverage window;
        window.time = {ends[i], ends[i + 1], 10};
        const std::size_t n = grid.size();
        for (std::size_t cell = 0; cell < n; ++cell)
        {
            const double x = -0.5 + 0.25 * (double(cell % 8) + 0.5);
            window.mean.solidity.push_back(solidityAt(i, x));
            for (const double u : {double(i), 0.0, 1.0})
            {
                window.mean.velocity.push_back(u);
            }
        }
        completeWindow(window, n, 1.01);
        writer.append(window);
    }
    writer.finish();
}

//- A case with that file, and the clock of these entries
class clockCase : public smallCase
{
    public:
    dictionary dict;
    std::unique_ptr<solidsClock> clock;

    explicit clockCase(const string& entries)
    : dict(entriesOf(entries))
    {
        const std::filesystem::path file = folder() / "solids.h5";
        writeSolids(file);
        clock.reset(new solidsClock(
            dict, "solids.h5", millfoam::averaging::SolidsReader(file),
            time()));
    }

    void expect(
        const scalar t, const std::array<std::size_t, 3>& windows,
        const std::array<double, 3>& shares) const
    {
        const solidsClock::moment found = clock->at(t);
        EXPECT_EQ(found.windows, windows) << t;
        for (std::size_t i = 0; i < 3; ++i)
        {
            EXPECT_NEAR(found.shares[i], shares[i], 1e-9) << t;
        }
    }
};

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(solidsClock, findsTheWindowAndItsNeighbours)
{
    // 0.1 s beside 0.2 s: a third of the way between the centres
    const clockCase box("outOfRange error;");
    box.expect(0, {0, 0, 1}, {0.5, 0.5, 0});
    box.expect(0.05, {0, 0, 1}, {0.125, 0.875 - 0.25 / 3, 0.25 / 3});
    box.expect(0.1, {0, 1, 2}, {2. / 3, 1. / 3, 0});
    box.expect(0.2, {0, 1, 2}, {0.5 / 3, 2. / 3, 0.5 / 3});
    box.expect(0.4, {1, 2, 2}, {0, 0.5, 0.5});
    EXPECT_TRUE(box.clock->spline());
}

TEST(solidsClock, aWindowIsValidFromBeginToEnd)
{
    const clockCase box("inTime window;");
    box.expect(0, {0, 0, 0}, {0, 1, 0});
    box.expect(0.099, {0, 0, 0}, {0, 1, 0});
    box.expect(0.1, {1, 1, 1}, {0, 1, 0});
    box.expect(0.299, {1, 1, 1}, {0, 1, 0});
    box.expect(0.4, {2, 2, 2}, {0, 1, 0});
    EXPECT_FALSE(box.clock->spline());
}

TEST(solidsClock, repeatsAcrossTheSeam)
{
    const clockCase box("outOfRange repeat;");
    box.expect(
        0.375, {1, 2, 0}, {0.0625 / 3, 1 - 0.0625 / 3 - 0.28125, 0.28125});
    box.expect(0.4, {2, 0, 1}, {0.5, 0.5, 0});
    box.expect(0, {2, 0, 1}, {0.5, 0.5, 0});
    box.expect(0.05 + 7 * 0.4, {2, 0, 1}, {0.125, 0.875 - 0.25 / 3, 0.25 / 3});
}

TEST(solidsClock, holdsTheLastWindow)
{
    const clockCase box("outOfRange hold;");
    box.expect(100, {1, 2, 2}, {0, 0.5, 0.5});
}

TEST(solidsClock, refusesTimesBeyondTheRecord)
{
    const clockCase box("outOfRange error;");
    for (const scalar t : {-0.01, 0.41})
    {
        const std::string error = errorOf([&] { box.clock->at(t); });
        EXPECT_NE(error.find("records DEM times 2 to 2.4 s"), std::string::npos)
            << error;
    }
}

TEST(solidsClock, refusesAFlowThatOutlastsTheRecord)
{
    clockCase box("outOfRange error;");
    // Of 1000 steps of 0.1 s
    EXPECT_NE(errorOf([&] { box.clock->checkSpan(); }), "");
    box.time().setEndTime(0.4);
    EXPECT_EQ(errorOf([&] { box.clock->checkSpan(); }), "");
}

TEST(solidsClock, holdsTheEndForALastStepThatEndsAfterTheFlow)
{
    clockCase box("outOfRange error;");
    Time& time = box.time();
    time.setEndTime(0.4);
    time.setDeltaT(0.15);
    while (time.run())
    {
        ++time;
        EXPECT_EQ(errorOf([&] { box.clock->at(time.value()); }), "");
    }
    EXPECT_NEAR(time.value(), 0.45, 1e-12);
    box.expect(time.value(), {1, 2, 2}, {0, 0.5, 0.5});
    EXPECT_NE(errorOf([&] { box.clock->at(0.551); }), "");

    // A flow that is to go on beyond the record
    time.setEndTime(0.42);
    EXPECT_NE(errorOf([&] { box.clock->at(time.value()); }), "");
}

TEST(solidsClock, refusesAnotherTime0)
{
    const std::string error = errorOf([] { clockCase box("time0 1.5;"); });
    EXPECT_NE(error.find("time0 is 1.5 s"), std::string::npos) << error;
}

TEST(solidsRecord, interpolatesLinearlyInSpaceAndSmoothlyInTime)
{
    smallCase box({{5, 4, 4}}, 0.08);
    writeSolids(box.folder() / "solids.h5");
    movingBed bed(
        entriesOf("solids \"solids.h5\"; outOfRange hold; ledgerCorrection no;"
                  "interpolation linear;"),
        box.mesh());
    ++box.time();
    bed.update();

    // At 0.8 of the first window: the velocity and the diameter are means that
    // the spline's phi u and phi/d have
    const millfoam::averaging::TimeSpline spline({0.1, 0.2, 0.1}, false);
    const auto shares = spline.at(0, 0.8).shares;
    forAll(bed.solidity(), celli)
    {
        const scalar x = box.mesh().C()[celli].x();
        const auto phi = spline.coefficients(
            {solidityAt(0, x), solidityAt(1, x), solidityAt(2, x)}, 0.9);
        const scalar first = (shares[0] + shares[1]) * phi[0];
        const scalar second = shares[2] * phi[1];
        EXPECT_GT(mag(first + second - solidityAt(0, x)), 1e-3);
        EXPECT_NEAR(bed.solidity()[celli], first + second, 1e-12);
        EXPECT_NEAR(bed.voidage()[celli], 1 - first - second, 1e-12);
        EXPECT_NEAR(
            bed.velocity()[celli].x(), second / (first + second), 1e-12);
        EXPECT_NEAR(bed.velocity()[celli].z(), 1, 1e-12);
        EXPECT_NEAR(bed.diameter()[celli], 0.01, 1e-14);
    }
}

TEST(solidsRecord, keepsTheMeansOfTheWindows)
{
    // Over the second window, by Gauss' rule of three points
    smallCase box({{5, 4, 4}}, 1e-3);
    writeSolids(box.folder() / "solids.h5");
    movingBed bed(
        entriesOf("solids \"solids.h5\"; outOfRange hold; ledgerCorrection no;"
                  "interpolation linear;"),
        box.mesh());
    scalarField mean(box.mesh().nCells(), Zero);
    const scalar off = std::sqrt(0.15);
    label index = 0;
    for (const scalar place : {0.5 - off, 0.5, 0.5 + off})
    {
        box.time().setTime(0.1 + 0.2 * place, ++index);
        bed.update();
        mean += (place == 0.5 ? 8 : 5) * bed.solidity().primitiveField() / 18;
    }
    forAll(mean, celli)
    {
        const scalar x = box.mesh().C()[celli].x();
        EXPECT_NEAR(mean[celli], solidityAt(1, x), 1e-12);
    }
}

TEST(solidsRecord, hasTheVolumeOfTheLedger)
{
    // The ledger says 1.01 m3; the cells of the unit cube sample 0.125
    smallCase box;
    writeSolids(box.folder() / "solids.h5");
    const string entries(
        "solids \"solids.h5\"; interpolation linear;"
        "outOfRange hold; inTime window; largestCorrection 1;");
    const std::string error =
        errorOf([&] { movingBed(entriesOf(entries), box.mesh()); });
    EXPECT_NE(error.find("1.01"), std::string::npos) << error;
    // Twice the edges: all voxels, 8 m3 of mean 0.125
    smallCase whole({{8, 8, 8}, {2, 2, 2}, [](const point& p) {
                         return p - vector(0.5, 0.5, 0.5);
                     }});
    writeSolids(whole.folder() / "solids.h5");
    const movingBed bed(
        entriesOf("solids \"solids.h5\"; interpolation cell; inTime window;"
                  "outOfRange hold;"),
        whole.mesh());
    EXPECT_NEAR(
        sum(bed.solidity().primitiveField() * whole.mesh().V()), 1.01, 1e-12);
}

// ************************************************************************* //
