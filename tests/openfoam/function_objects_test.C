/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    Function objects on fields whose sums, moments and fluxes are known.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "averaging/files/slurry_file.hpp"
#include "axialProfiles.H"
#include "fluidOnBalls.H"
#include "singlePhaseTransportModel.H"
#include "slurryBalance.H"
#include "smallCase.H"
#include "surfaceFields.H"
#include "turbulentTransportModel.H"
#include "voxelAverages.H"
#include "weightedSpread.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar density = 1239;
constexpr scalar kinematicViscosity = 1e-3;

//- A viscosity for balls
slurryViscosity water()
{
    return {dictionary::null, millfoam::drag::FlowCurve::newtonian(1e-3)};
}

//- Depth of the box along z, m; along x and y it is 1 m
constexpr scalar depth = 0.5;

//- A box of slurry, with the fields that function objects look for
class flowCase : public smallCase
{
    static smallBox box()
    {
        return {{8, 6, 4}, {1, 1, depth}};
    }

    public:
    volScalarField alpha;
    volScalarField rho;
    volScalarField p;
    volScalarField p_rgh;
    volVectorField U;
    surfaceScalarField phi;
    surfaceScalarField slurry;
    autoPtr<singlePhaseTransportModel> transport;
    autoPtr<incompressible::turbulenceModel> turbulence;

    flowCase()
    : smallCase(box(), 0.25),
      alpha(field<scalar>("alpha.slurry", dimless, 1)),
      rho(field<scalar>("rho", dimDensity, density)),
      p(field<scalar>("p", dimPressure, 0, "calculated")),
      p_rgh(field<scalar>("p_rgh", dimPressure, 0)),
      U(field<vector>("U", dimVelocity, vector::zero, "fixedValue")),
      phi(faces("phi")),
      slurry(faces("alphaPhi.slurry"))
    {
        write(
            "constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);",
            "uniformDimensionedVectorField");
        write(
            "constant/transportProperties",
            "transportModel Newtonian; nu [0 2 -1 0 0 0 0] 1e-3;");
        write("constant/turbulenceProperties", "simulationType laminar;");
        transport.reset(new singlePhaseTransportModel(U, phi));
        turbulence.reset(
            incompressible::turbulenceModel::New(U, phi, transport()).ptr());
    }

    //- A flux of nothing
    surfaceScalarField faces(const word& name)
    {
        return surfaceScalarField(
            IOobject(name, time().timeName(), mesh()), mesh(),
            dimensionedScalar(dimVolume / dimTime, Zero));
    }

    //- Values at the centres of cells and faces
    template <class Type, class Formula>
    void
    set(GeometricField<Type, fvPatchField, volMesh>& field,
        const Formula& formula)
    {
        forAll(field, celli)
        {
            field[celli] = formula(mesh().C()[celli]);
        }
        forAll(mesh().boundary(), patchi)
        {
            const vectorField& centres = mesh().boundary()[patchi].Cf();
            Field<Type> values(centres.size());
            forAll(centres, i)
            {
                values[i] = formula(centres[i]);
            }
            field.boundaryFieldRef()[patchi] == values;
        }
    }

    //- Turn the fluid as a whole about z, with this angular speed, rad/s
    void turn(const scalar omega)
    {
        set(U, [=](const point& x)
            { return vector(-omega * x.y(), omega * x.x(), 0); });
    }

    //- Numbers of the last line of a file in postProcessing
    std::vector<double> lastLine(const std::string& name) const
    {
        std::istringstream all(text_of(folder() / "postProcessing" / name));
        std::string line;
        for (std::string next; std::getline(all, next);)
        {
            line = next;
        }
        std::istringstream numbers(line);
        std::vector<double> result;
        for (double number; numbers >> number;)
        {
            result.push_back(number);
        }
        return result;
    }
};

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(slurryTorque, aBodyThatTurnsHasItsMomentOfInertia)
{
    flowCase box;
    const scalar omega = 3;
    box.turn(omega);
    const slurryFields fields(box.mesh(), dictionary::null);
    const slurryTorque torque(fields, entriesOf("speed 1;"));

    // About a corner (1 + 1)/3 of the mass; the cells' centres do not see what
    // they turn about themselves, (dx^2 + dy^2)/12
    const scalar own = (1.0 / 64 + 1.0 / 36) / 12;
    const scalar mass = density * depth;
    EXPECT_NEAR(torque.momentum(), mass * omega * (2.0 / 3 - own), 1e-9 * mass);
}

TEST(slurryTorque, wallsCarryTheWeightOfAFluidAtRest)
{
    flowCase box;
    box.set(box.p, [](const point& x) { return 9.81 * density * (2 - x.y()); });
    const slurryFields fields(box.mesh(), dictionary::null);
    const slurryTorque torque(fields, entriesOf("speed 0;"));

    // Its weight at the middle, x = 0.5
    const scalar expected = 9.81 * density * depth * 0.5;
    EXPECT_NEAR(sum(torque.ofWalls()), expected, 1e-9 * expected);
    EXPECT_NEAR(torque.drain(), expected, 1e-9 * expected);
}

TEST(slurryTorque, aSlidingLidGivesItsShearStress)
{
    flowCase box;
    const scalar shear = 4;
    box.set(box.U, [=](const point& x) { return vector(shear * x.y(), 0, 0); });
    const slurryFields fields(box.mesh(), dictionary::null);
    const slurryTorque torque(
        fields, entriesOf("walls (top); resting (top); speed 1;"));

    const scalar force = density * kinematicViscosity * shear * depth;
    ASSERT_EQ(torque.names(), wordList({"top"}));
    EXPECT_NEAR(torque.ofWalls()[0], -force, 1e-12);
}

TEST(slurryTorque, wallsThatTurnWithTheFluidGiveNoFriction)
{
    flowCase box;
    const scalar omega = 3;
    box.turn(omega);
    const slurryFields fields(box.mesh(), dictionary::null);
    const slurryTorque turning(fields, entriesOf("speed 3;"));
    const slurryTorque resting(
        fields, entriesOf("walls (top); resting (top); speed 3;"));

    EXPECT_NEAR(sum(turning.ofWalls()), 0, 1e-12);
    // Without the wall's own turn, dU/dy = -omega along x, at a distance of 1 m
    const scalar wrong = density * kinematicViscosity * omega * depth;
    EXPECT_NEAR(sum(resting.ofWalls()), wrong, 1e-12);
    EXPECT_EQ(sum(resting.powers(resting.ofWalls())), 0);
    // Of the other walls, which turn with the fluid: to round-off
    EXPECT_NEAR(resting.power(2, resting.ofWalls()), 0, 1e-12);
    EXPECT_NEAR(turning.power(2, turning.ofWalls()), 3 * 2, 1e-12);
}

TEST(slurryTorque, wallsWithRestingWallVelocityRestOfThemselves)
{
    flowCase box;
    const scalar shear = 4;
    box.set(box.U, [=](const point& x) { return vector(shear * x.y(), 0, 0); });
    const label top = box.mesh().boundaryMesh().findPatchID("top");
    const label bottom = box.mesh().boundaryMesh().findPatchID("bottom");
    const vectorField values(box.U.boundaryField()[top]);
    box.U.boundaryFieldRef().set(
        top, fvPatchVectorField::New(
                 "restingWallVelocity", box.mesh().boundary()[top], box.U()));
    box.U.boundaryFieldRef()[top] == values;
    const slurryFields fields(box.mesh(), dictionary::null);
    const slurryTorque all(fields, entriesOf("speed 3;"));
    const slurryTorque some(fields, entriesOf("walls (bottom); speed 3;"));

    EXPECT_EQ(all.speedOf(top), 0);
    EXPECT_EQ(some.speedOf(top), 0);
    EXPECT_EQ(some.speedOf(bottom), 3);
    const scalarField torques(all.ofWalls());
    EXPECT_EQ(all.powers(torques)[top], 0);
    EXPECT_NE(torques[top], 0);
    // All walls that turn count, also those that are not reported
    const scalar power = 3 * (sum(torques) - torques[top]);
    EXPECT_NEAR(all.power(2, torques), power, 1e-12 * mag(power));
    EXPECT_NEAR(some.power(2, some.ofWalls()), power, 1e-12 * mag(power));
}

TEST(slurryTorque, aMissingFieldNamesTheFunctionObject)
{
    flowCase box;
    dictionary entries(entriesOf("phase pulp; speed 1;"));
    entries.name() = "system/controlDict.functions.balance";
    const slurryFields fields(box.mesh(), entries);
    const std::string error = errorOf([&] { fields.alpha(); });
    EXPECT_NE(error.find("alpha.pulp"), std::string::npos) << error;
    EXPECT_NE(
        error.find("balance: the flow has no volScalarField"),
        std::string::npos)
        << error;
}

TEST(slurryTorque, ballsBetweenWallsAtRestGiveTheOppositeOfWhatTheyFeel)
{
    flowCase box;
    box.turn(2);
    const vectorField& C = box.mesh().C();
    const scalarField& V = box.mesh().V();
    const scalar phi = 0.3, exchange = 1e4, gradient = 50;
    const auto feel = [&]
    {
        // Balls at rest in the fluid that turns, and a pressure that falls along y
        return ballForces{
            scalarField(C.size(), phi),
            vectorField(C.size(), vector(0, gradient, 0)),
            scalarField(C.size(), exchange), vectorField(C.size(), Zero),
            scalarField(C.size(), 0.005)};
    };
    const dictionary resting(entriesOf("walls (top); resting (top); speed 2;"));
    const slurryFields fields(box.mesh(), dictionary::null);
    EXPECT_FALSE(slurryTorque(fields, resting).knowsBalls());
    {
        const fluidOnBalls mixed(
            box.mesh(), {"Hill", true, density, 1.2, gravity, water(), false},
            feel);
        EXPECT_FALSE(slurryTorque(fields, resting).knowsBalls());
    }
    const fluidOnBalls onBalls(
        box.mesh(), {"Hill", false, density, 1.2, gravity, water(), false},
        feel);
    EXPECT_FALSE(slurryTorque(fields, entriesOf("speed 2;")).knowsBalls());

    const slurryTorque torque(fields, resting);
    ASSERT_TRUE(torque.knowsBalls());
    const scalar drag =
        phi * exchange * 2 *
        sum(V * (sqr(C.component(vector::X)) + sqr(C.component(vector::Y))));
    const scalar pressure = phi * gradient * depth * 0.5;
    EXPECT_NEAR(torque.ofBalls(), -drag - pressure, 1e-9 * drag);
}

TEST(slurryTorque, refusesRestingPatchesThatAreNoWalls)
{
    flowCase box;
    const slurryFields fields(box.mesh(), dictionary::null);
    const std::string error = errorOf(
        [&]
        {
            slurryTorque(
                fields,
                entriesOf("walls (top bottom); resting (\"(top|bottom)\" left);"
                          " speed 1;"));
        });
    EXPECT_NE(error.find("expected patches of walls"), std::string::npos)
        << error;
}

TEST(slurryTorque, refusesWallsThatAreNotThere)
{
    flowCase box;
    const slurryFields fields(box.mesh(), dictionary::null);
    const std::string error = errorOf(
        [&] { slurryTorque(fields, entriesOf("walls (roof); speed 1;")); });
    EXPECT_NE(error.find("no patch has such a name"), std::string::npos)
        << error;
}

TEST(slurryBalance, addsUpWhatComesAndGoes)
{
    flowCase box;
    box.alpha = 0.5;
    // Where the field has a fixed value, slurry is fed
    const label left = box.mesh().boundaryMesh().findPatchID("left");
    box.alpha.boundaryFieldRef().set(
        left, fvPatchScalarField::New(
                  "fixedValue", box.mesh().boundary()[left], box.alpha()));
    box.alpha.boundaryFieldRef()[left] == 0.5;
    box.alpha.correctBoundaryConditions();
    functionObjects::slurryBalance balance(
        "balance", box.time(), entriesOf("speed -2; walls (top);"));
    // 0.3 m3/s in and 0.1 m3/s out, for two steps of 0.25 s
    const label right = box.mesh().boundaryMesh().findPatchID("right");
    box.slurry.boundaryFieldRef()[left] =
        -0.3 / box.mesh().boundary()[left].size();
    box.slurry.boundaryFieldRef()[right] =
        0.1 / box.mesh().boundary()[right].size();
    for (label step = 0; step < 2; ++step)
    {
        ++box.time();
        box.alpha += 0.2 * 0.25 / depth;
        balance.execute();
    }
    // 2 litres from nowhere
    box.alpha[0] += 2e-3 / box.mesh().V()[0];
    balance.execute();
    balance.write();

    const std::vector<double> found(
        box.lastLine("balance/0/slurryBalance.dat"));
    ASSERT_GE(found.size(), 10u);
    const double expected[] = {0.5, 0.25 + 0.1 + 0.002, 0.3, 0.1, 0.225, 0.075};
    for (std::size_t i = 0; i < 6; ++i)
    {
        EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
    }
    // The third execution fed and discharged without a change of the hold-up
    EXPECT_NEAR(found[6], 0.002 - 0.05, 1e-12);
}

TEST(axialProfiles, cellsCountInTheSlicesThatTheyReachOver)
{
    // Cells of a quarter of the depth, slices of a third; slurry in the second
    // layer alone: one third of it in the first slice, two in the second
    flowCase box;
    box.set(
        box.alpha, [](const point& x)
        { return x.z() > depth / 4 && x.z() < depth / 2 ? 1.0 : 0.0; });
    box.set(box.p_rgh, [](const point& x) { return 100 * x.z(); });
    functionObjects::axialProfiles profiles(
        "profiles", box.time(), entriesOf("slices 3; ends (0 0.5);"));
    ++box.time();
    profiles.execute();
    profiles.write();

    const scalar layer = depth / 4;
    const std::map<std::string, std::vector<double>> expected{
        {"holdUp", {0.25, layer / 3, 2 * layer / 3, 0}},
        {"height", {0.25, 0.5, 0.5, 0}},
        {"x", {0.25, 0.5, 0.5, 0}},
        {"p_rgh", {0.25, 150 * layer, 150 * layer, 0}}};
    for (const auto& [name, values] : expected)
    {
        const std::vector<double> found(
            box.lastLine("profiles/0/" + name + ".dat"));
        ASSERT_EQ(found.size(), values.size()) << name;
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            EXPECT_NEAR(found[i], values[i], 1e-12) << name << ' ' << i;
        }
    }
}

TEST(voxelAverages, voxelsGiveTheBallsWhatTheCellsGiveThem)
{
    flowCase box;
    box.set(box.U, [](const point& x) { return vector(x.y(), -x.x(), 0.5); });
    // Steep fields on voxels that cut the cells
    const vectorField& C = box.mesh().C();
    const scalarField& V = box.mesh().V();
    label computed = 0;
    const scalarField solidity(0.6 * C.component(vector::X));
    const vectorField pressure(1e4 * C);
    const scalarField exchange(1e3 + 1e5 * C.component(vector::Y));
    const vectorField balls(2 * box.U.primitiveField());
    const fluidOnBalls onBalls(
        box.mesh(), {"Hill", true, density, 1.2, gravity, water(), false},
        [&]
        {
            ++computed;
            return ballForces{
                solidity, pressure, exchange, balls,
                scalarField(C.size(), 0.005)};
        });
    functionObjects::voxelAverages averages(
        "voxels", box.time(),
        entriesOf("lower (0 0 0); upper (1 1 0.5); shape (5 5 1); window 1;"
                  " interval 0.5;"));
    for (label step = 0; step < 4; ++step)
    {
        ++box.time();
        averages.execute();
    }
    averages.end();
    // Each second time-step of 0.25 s has a sample
    EXPECT_EQ(computed, 2);

    using namespace millfoam::averaging;
    SlurrySegment sums(25, true);
    const BoxGrid grid({0, 0, 0}, {1, 1, depth}, {5, 5, 1});
    for (const auto& entry : std::filesystem::directory_iterator(
             box.folder() / "postProcessing" / "voxels" / "segments"))
    {
        sums.add(read_segment(entry.path(), grid, true));
    }
    // Of what balls feel, a component's sum over the voxels
    const auto total = [&](const std::size_t component)
    {
        scalar result = 0;
        for (std::size_t i = slurry_components + component;
             i < sums.components.size(); i += sums.width)
        {
            result += sums.components[i];
        }
        return result;
    };
    const scalarField weight((solidity + few_balls) * V);
    EXPECT_NEAR(total(0) / sum(weight), 1, 1e-12);
    EXPECT_NEAR(total(1) / sum(solidity * V), 1, 1e-12);
    EXPECT_NEAR(total(5) / sum(weight * exchange), 1, 1e-12);
    EXPECT_NEAR(total(12) / (density * sum(weight)), 1, 1e-12);
    EXPECT_NEAR(total(13) / (0.005 * sum(weight)), 1, 1e-12);
    for (direction axis = 0; axis < 3; ++axis)
    {
        const scalarField push(pressure.component(axis));
        const scalarField velocity(box.U.primitiveField().component(axis));
        EXPECT_NEAR(total(2 + axis) / sum(weight * push), 1, 1e-12);
        // Balls twice as fast as the fluid
        EXPECT_NEAR(
            total(6 + axis) / sum(weight * exchange * velocity), -1, 1e-12);
        EXPECT_NEAR(total(9 + axis) / sum(weight * velocity), 2, 1e-12);
    }
}

TEST(weightedSpread, countsByWeight)
{
    scalarField values(100), weights(100, 1.0);
    forAll(values, i)
    {
        values[i] = 100 - i;
    }
    const weightedSpread even = spreadOf(values, weights);
    EXPECT_NEAR(even.mean, 50.5, 1e-12);
    EXPECT_EQ(even.high, 95);
    EXPECT_EQ(even.largest, 100);

    const weightedSpread heavy = spreadOf(
        scalarField(scalarList{1, 2, 3}), scalarField(scalarList{0, 39, 1}));
    EXPECT_NEAR(heavy.mean, 2.025, 1e-12);
    EXPECT_EQ(heavy.high, 2);
    EXPECT_EQ(heavy.largest, 3);
    EXPECT_EQ(spreadOf(scalarField(1, 7.0), scalarField(1, 0.0)).mean, 0);
}

// ************************************************************************* //
