/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    sweptFluid: meshes that move through a voidage that rests in space.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "smallCase.H"
#include "sweptFluid.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar sweptStep = 0.1;

const string exact("solvers { sweptPotential { solver PCG; preconditioner DIC;"
                   " tolerance 1e-15; relTol 0; } }");

//- A box that moves through a voidage that is known in space
class sweptCase : public smallCase
{
    std::function<scalar(const point&)> formula_;

    void fill()
    {
        forAll(voidage, celli)
        {
            voidage[celli] = formula_(mesh().C()[celli]);
        }
        voidage.correctBoundaryConditions();
    }

    public:
    volScalarField voidage;
    sweptFluid swept;

    sweptCase(
        const string& solution,
        const std::function<scalar(const point&)>& formula)
    : smallCase({{8, 6, 3}, {1, 0.8, 0.4}, skewed}, sweptStep, solution),
      formula_(formula),
      voidage(field<scalar>("voidage", dimless, 1)),
      swept(voidage, false)
    {
        fill();
        voidage.oldTime();
    }

    //- Carry the points on by a time-step, and set the voidage; change: what
    //  the bed has grown by there
    void move(
        const std::function<vector(const point&)>& way, const scalar change = 0)
    {
        ++time();
        pointField points(mesh().points());
        for (point& p : points)
        {
            p += way(p);
        }
        mesh().movePoints(points);
        fill();
        voidage.primitiveFieldRef() += change;
        voidage.correctBoundaryConditions();
    }

    //- A rate in all cells, 1/s
    volScalarField::Internal rate(const scalar value)
    {
        return volScalarField::Internal(
            IOobject("rate", time().timeName(), mesh()), mesh(),
            dimensionedScalar("rate", dimless / dimTime, value));
    }

    //- Largest difference of the room from its mean over the volume, 1/s
    scalar unevenness() const
    {
        const scalarField room(swept.room()().field());
        const scalarField& V = voidage.mesh().V();
        return max(mag(room - sum(room * V) / sum(V)));
    }
};

scalar wavy(const point& x)
{
    return 0.6 + 0.2 * std::sin(3 * x.x() + 2 * x.y());
}

vector shift(const point&)
{
    return vector(0.03, 0.01, 0);
}

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(sweptFluid, ofAUniformVoidageLeavesNoRoom)
{
    // Also where cells grow: the faces sweep what they grow by
    sweptCase box(exact, [](const point&) { return 0.6; });
    box.move([](const point& x) { return 0.1 * x + shift(x); });
    box.swept.update();
    EXPECT_GT(min(box.swept.growth()().field()), 0.1);
    EXPECT_LT(max(mag(box.swept.room()().field())), 1e-12);
}

TEST(sweptFluid, agreesWithABedAtRestByAPotential)
{
    sweptCase box(exact, wavy);
    box.move(shift);
    box.swept.update();
    EXPECT_GT(box.unevenness(), 1e-3);
    const scalarField plain(box.swept.flux().primitiveField());

    box.swept.update(box.rate(0), "p_rgh");
    EXPECT_LT(box.unevenness(), 1e-10);
    // What the correction adds is a part of what is swept
    const scalarField found(box.swept.flux().primitiveField());
    EXPECT_LT(max(mag(found - plain)), 0.25 * max(mag(plain)));
}

TEST(sweptFluid, leavesTheRateOfTheBedAsRoom)
{
    sweptCase box(exact, wavy);
    box.move(shift, 0.02);
    box.swept.update(box.rate(0.02 / sweptStep), "p_rgh");
    EXPECT_LT(box.unevenness(), 1e-10);
    const scalarField room(box.swept.room()().field());
    const scalarField& V = box.mesh().V();
    sweptCase still(exact, wavy);
    still.move(shift);
    still.swept.update(still.rate(0), "p_rgh");
    EXPECT_NEAR(
        sum(room * V) / sum(V) - still.swept.room()()[0], 0.02 / sweptStep,
        1e-3);
}

TEST(sweptFluid, takesThePressuresSolverWhereItHasNone)
{
    sweptCase box(
        "solvers { p_rgh { solver PCG; preconditioner DIC; tolerance 1e-15;"
        " relTol 0; } }",
        wavy);
    box.move(shift);
    box.swept.update();
    const scalar before = box.unevenness();
    box.swept.update(box.rate(0), "p_rgh");
    EXPECT_LT(box.unevenness(), 0.1 * before);
    EXPECT_GT(box.unevenness(), 1e-6 * before);
}

TEST(sweptFluid, onAMeshAtRestIsNothing)
{
    sweptCase box(exact, wavy);
    ++box.time();
    box.voidage.primitiveFieldRef() -= 0.05;
    const scalarField room(box.swept.room()().field());
    EXPECT_NEAR(min(room), -0.05 / sweptStep, 1e-12);
    EXPECT_NEAR(max(room), -0.05 / sweptStep, 1e-12);
    EXPECT_EQ(max(mag(box.swept.flux().primitiveField())), 0);
}

// ************************************************************************* //
