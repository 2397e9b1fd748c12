/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    solidsRecord of a cylinder that turns: on a ring of cells that turns with it
    or rests, compared with formulas.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "averaging/files/solids_file.hpp"
#include "movingBed.H"
#include "smallCase.H"
#include "solidsWindow.H"
#include "uniformDimensionedFields.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

//- A ring of cells around the axis, in a case with the solids of a cylinder that
//  turns: one window over the whole run
class ringCase : public smallCase
{
    pointField atTime0_;

    static point onRing(const point& p)
    {
        const scalar theta = constant::mathematical::twoPi * p.y();
        const scalar r = inner + (1 - inner) * p.x();
        return point(r * std::cos(theta), r * std::sin(theta), height * p.z());
    }

    static void writeSolids(const std::filesystem::path& path)
    {
        using namespace millfoam::averaging;
        const CylinderGrid grid(
            {inner, 1}, {0, height}, {16, 180, 2}, false, {true, omega});
        SolidsHeader header;
        header.time0 = time0;
        header.timestep = 1e-5;
        header.whole_run = true;
        header.angular_velocity = omega;
        const std::size_t n = grid.size();
        WindowAverage window;
        window.time = {time0, time0 + 1, 100};
        for (std::size_t cell = 0; cell < n; ++cell)
        {
            const double r =
                inner + grid.spacing()[0] * (double(cell % 16) + 0.5);
            const double theta =
                grid.spacing()[1] * (double(cell / 16 % 180) + 0.5);
            window.mean.solidity.push_back(solidityAt(theta));
            for (const double u : {0.1, 3 * r, 0.2})
            {
                window.mean.velocity.push_back(u);
            }
        }
        completeWindow(window, n, volume());
        SolidsWriter writer(path, grid, header);
        writer.append(window);
        writer.finish();
    }

    public:
    //- Of the cylinder, rad/s; its inner radius and height, m; DEM time at flow
    //  time 0, s
    static constexpr scalar omega = 5;
    static constexpr scalar inner = 0.2;
    static constexpr scalar height = 0.5;
    static constexpr scalar time0 = 2;

    std::unique_ptr<dictionary> dict;
    std::unique_ptr<movingBed> bed;

    explicit ringCase(const scalar deltaT, const string& entries = "")
    : smallCase({{8, 40, 2}, {1, 1, 1}, onRing}, deltaT),
      atTime0_(mesh().points())
    {
        writeSolids(folder() / "solids.h5");
        dict.reset(new dictionary(entriesOf(
            "solids \"solids.h5\"; interpolation linear;" + entries)));
    }

    //- Solidity at an azimuth of the cylinder
    static scalar solidityAt(const scalar theta)
    {
        return 0.3 + 0.1 * std::cos(theta);
    }

    //- Velocity of balls that turn at 3 rad/s, spread and rise, m/s
    static vector velocityAt(const point& p)
    {
        const scalar r = std::hypot(p.x(), p.y());
        return vector(
            0.1 * p.x() / r - 3 * p.y(), 0.1 * p.y() / r + 3 * p.x(), 0.2);
    }

    //- Volume of the balls, m3
    static scalar volume()
    {
        return 0.3 * constant::mathematical::pi * (1 - sqr(inner)) * height;
    }

    //- Turn the mesh to its place at the flow's time
    void turn()
    {
        const scalar angle = omega * (time0 + time().value());
        const scalar c = std::cos(angle), s = std::sin(angle);
        mesh().movePoints(tensor(c, -s, 0, s, c, 0, 0, 0, 1) & atTime0_);
    }

    void makeBed()
    {
        bed.reset(new movingBed(*dict, mesh()));
    }

    //- Solidity of the cylinder where a cell is, at a DEM time, s
    scalar solidityOf(const label celli, const scalar t)
    {
        const vector& centre = mesh().C()[celli];
        return solidityAt(std::atan2(centre.y(), centre.x()) - omega * t);
    }
};

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(solidsOnATurningCylinder, restOnAMeshThatTurnsWithIt)
{
    ringCase ring(0.013, "ledgerCorrection no;");
    ring.turn();
    ring.makeBed();
    const scalarField first(ring.bed->solidity().primitiveField());
    for (label step = 0; step < 5; ++step)
    {
        ++ring.time();
        ring.turn();
        ring.bed->update();
        const scalar t = ring.time0 + ring.time().value();
        forAll(first, celli)
        {
            const scalar phi = ring.bed->solidity()[celli];
            EXPECT_NEAR(phi, first[celli], 1e-12);
            EXPECT_NEAR(phi, ring.solidityOf(celli, t), 2e-5);
            const vector expected(ring.velocityAt(ring.mesh().C()[celli]));
            EXPECT_LT(mag(ring.bed->velocity()[celli] - expected), 1e-12);
        }
    }
}

TEST(solidsOnATurningCylinder, passAMeshAtRest)
{
    ringCase ring(0.05, "ledgerCorrection no;");
    ring.makeBed();
    for (label step = 0; step < 3; ++step)
    {
        ++ring.time();
        ring.bed->update();
        const scalar t = ring.time0 + ring.time().value();
        forAll(ring.mesh().C(), celli)
        {
            const vector& centre = ring.mesh().C()[celli];
            EXPECT_NEAR(
                ring.bed->solidity()[celli], ring.solidityOf(celli, t), 2e-5);
            EXPECT_LT(
                mag(ring.bed->velocity()[celli] - ring.velocityAt(centre)),
                1e-12);
        }
    }
}

TEST(solidsOnATurningCylinder, wereWhereTheyTurnedFromInTheStepBefore)
{
    ringCase ring(0.02, "ledgerCorrection no;");
    ring.turn();
    ring.makeBed();
    ++ring.time();
    ring.turn();
    const scalarField before(ring.bed->voidageBefore()().field());
    ring.bed->update();
    const scalar t = ring.time0 + ring.time().value();
    forAll(before, celli)
    {
        const scalar old = ring.solidityOf(celli, t - 0.02);
        EXPECT_NEAR(1 - before[celli], old, 2e-5);
        EXPECT_NEAR(
            ring.bed->solidity()[celli], ring.solidityOf(celli, t), 2e-5);
    }
}

TEST(solidsOnATurningCylinder, keepTheVolumeOfTheLedger)
{
    ringCase ring(0.03);
    ring.turn();
    ring.makeBed();
    for (label step = 0; step < 3; ++step)
    {
        ++ring.time();
        ring.turn();
        ring.bed->update();
        const scalar found = sum(
            ring.bed->solidity().primitiveField() * ring.mesh().V().field());
        EXPECT_NEAR(found / ring.volume(), 1, 1e-12);
    }
}

TEST(solidsOnATurningCylinder, refuseAFlowOfAnotherSpeed)
{
    ringCase ring(0.01, "omega -5;");
    const std::string error = errorOf([&] { ring.makeBed(); });
    EXPECT_NE(error.find("omega is -5 rad/s"), std::string::npos) << error;
    EXPECT_NE(error.find("turned with 5 rad/s"), std::string::npos) << error;
    ringCase same(0.01, "omega 5;");
    EXPECT_EQ(errorOf([&] { same.makeBed(); }), "");
}

TEST(solidsOnATurningCylinder, doNotTurnAChargeRoundALyingMill)
{
    const auto errorWith = [](const vector& g)
    {
        ringCase ring(0.01);
        const uniformDimensionedVectorField registered(
            IOobject("g", ring.time().constant(), ring.mesh()),
            dimensionedVector("g", dimAcceleration, g));
        return errorOf([&] { ring.makeBed(); });
    };
    const std::string error = errorWith(gravity);
    EXPECT_NE(error.find("whole run"), std::string::npos) << error;
    EXPECT_NE(error.find("a cylinder that turns"), std::string::npos) << error;
    EXPECT_EQ(errorWith(vector(0, 0, -9.81)), "");
}

// ************************************************************************* //
