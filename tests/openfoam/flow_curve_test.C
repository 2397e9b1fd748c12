/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    The flow curves that drag and grates evaluate, compared with the viscosity
    models that the flow uses: OpenFOAM's and Bingham, in a box of fluid in
    simple shear. Darcy's gradient of a bed for each model.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "bedDrag.H"
#include "flowCurve.H"
#include "fvcFlux.H"
#include "mixtureFluids.H"
#include "slurryViscosity.H"
#include "smallCase.H"
#include "viscosityModel.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar slurrysDensity = 1239;

//- Entries of a phase of each model; kinematic, but for Bingham's
const std::map<string, string> models{
    {"Newtonian", "transportModel Newtonian; nu 1e-6;"},
    {"biviscosity", "transportModel Bingham; BinghamCoeffs { yieldStress 0.16;"
                    " plasticViscosity 0.0014; viscosityRatio 1000; }"},
    {"Papanastasiou",
     "transportModel Bingham; yieldStress 0.16; plasticViscosity 0.0014;"
     " regularisation Papanastasiou; m 3;"},
    {"HerschelBulkley",
     "transportModel HerschelBulkley; HerschelBulkleyCoeffs { nu0 1e-3;"
     " tau0 1e-4; k 2e-5; n 0.6; }"},
    {"Casson",
     "transportModel Casson; m 1e-6; tau0 1e-4; nuMin 2e-6; nuMax 1e-3;"},
    {"CrossPowerLaw",
     "transportModel CrossPowerLaw; nu0 1e-3; nuInf 1e-6; m 10; n 0.8;"},
    {"powerLaw",
     "transportModel powerLaw; powerLawCoeffs { k 2e-5; n 0.4; nuMin 1e-6;"
     " nuMax 1e-3; }"}};

dictionary phaseOf(const string& entries)
{
    return entriesOf(entries + " rho 1239;");
}

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(flowCurve, isTheFlowsViscosityAtEveryRate)
{
    smallCase box({{3, 5, 3}});
    for (const auto& [name, entries] : models)
    {
        const dictionary phase(phaseOf(entries));
        const millfoam::drag::FlowCurve curve(flowCurveOf(phase));
        for (scalar rate = 1e-4; rate < 1e6; rate *= 3)
        {
            volVectorField U(box.field<vector>("U", dimVelocity, vector::zero));
            U.primitiveFieldRef() =
                rate * box.mesh().C().component(1)().primitiveField() *
                vector(1, 0, 0);
            forAll(U.boundaryField(), patchi)
            {
                U.boundaryFieldRef()[patchi] ==
                    rate* box.mesh().Cf().boundaryField()[patchi].component(1) *
                        vector(1, 0, 0);
            }
            const surfaceScalarField phi(fvc::flux(U));
            const autoPtr<viscosityModel> model(
                viscosityModel::New("nu", phase, U, phi));
            const scalar found = slurrysDensity * model().nu()()[22];
            EXPECT_NEAR(curve.apparent_viscosity(rate), found, 1e-9 * found)
                << name << " " << rate;
        }
    }
}

TEST(flowCurve, givesTheDragOfEachModel)
{
    // Darcy's law: beta = 150 mu phi^2/(e d^2) with mu of the pores' rate
    smallCase box({{2, 2, 2}});
    const movingBed bed(
        entriesOf("block { box (-9 -9 -9) (9 9 9); solidity 0.5; diameter"
                  " 0.005; velocity (0.2 0 0); }"),
        box.mesh());
    const volScalarField alpha(
        box.field<scalar>("alpha.slurry", dimless, scalar(1)));
    const volVectorField U(
        box.field<vector>("U", dimVelocity, vector(0.1, 0, 0)));
    const scalar rate = 12 * 0.1 / 0.005;
    for (const auto& [name, entries] : models)
    {
        const auto curve = flowCurveOf(phaseOf(entries));
        const bedDrag drag(
            entriesOf("law Darcy; viscosity pore;"),
            {{1.2, 1.8e-5}, slurrysDensity, curve});
        const scalar mu = curve.apparent_viscosity(rate);
        const scalar expected = 150 * mu * 0.25 / (0.5 * 2.5e-5);
        EXPECT_NEAR(
            drag.exchange(bed, alpha, U)()[3], expected, 1e-12 * expected)
            << name;
    }
}

TEST(flowCurve, givesDarcysGradientOfANewtonianSlurry)
{
    // beta/e = 150 mu phi^2/(e^2 d^2) = 8400 Pa s/m2 at mu 1.4 mPa s, phi 0.5
    // and d 5 mm
    smallCase box({{2, 2, 2}});
    const movingBed bed(
        entriesOf("block { box (-9 -9 -9) (9 9 9); solidity 0.5; diameter"
                  " 0.005; velocity (0 0 0); }"),
        box.mesh());
    const bedDrag drag(
        entriesOf("law Darcy;"),
        {{1.2, 1.8e-5},
         slurrysDensity,
         flowCurveOf(entriesOf(
             "transportModel Newtonian; nu 1.1299435e-6; rho 1239;"))});
    const scalar beta = drag.exchange(
        bed, box.field<scalar>("alpha.slurry", dimless, scalar(1)),
        box.field<vector>("U", dimVelocity, vector(1, 0, 0)))()[3];
    EXPECT_NEAR(beta / 0.5, 8400, 0.01);
}

TEST(flowCurve, refusesModelsWithoutOne)
{
    const std::string error = errorOf(
        [] { flowCurveOf(phaseOf("transportModel strainRateFunction;")); });
    EXPECT_NE(
        error.find("transportModel is strainRateFunction"), std::string::npos)
        << error;
    EXPECT_NE(error.find("HerschelBulkley"), std::string::npos) << error;
}

TEST(flowCurve, refusesMisspeltEntriesOfBingham)
{
    const string entries("yieldStress 0.16; plasticViscosity 0.0014;"
                         " viscosityRatio 1000; regularization Papanastasiou;");
    const string inCoeffs("BinghamCoeffs { " + entries + " m 3; }");
    for (const string& phase : {entries, inCoeffs})
    {
        const std::string error = errorOf(
            [&] { flowCurveOf(phaseOf("transportModel Bingham; " + phase)); });
        EXPECT_NE(error.find("'regularization'"), std::string::npos) << error;
    }
}

TEST(flowCurve, refusesParametersThatDescribeNothing)
{
    const std::string error = errorOf(
        []
        {
            flowCurveOf(phaseOf("transportModel powerLaw; k 1; n 1; nuMin 2;"
                                "nuMax 1;"));
        });
    EXPECT_NE(error.find("powerLaw: the largest viscosity"), std::string::npos)
        << error;
}

TEST(slurryViscosity, isPlasticWhereTheSlurryHasOne)
{
    const auto bingham = flowCurveOf(phaseOf(models.at("biviscosity")));
    const auto herschel = flowCurveOf(phaseOf(models.at("HerschelBulkley")));
    const dictionary none;
    EXPECT_EQ(slurryViscosity(none, bingham).name(), "plastic");
    EXPECT_EQ(slurryViscosity(none, bingham).at(1), 0.0014);
    EXPECT_EQ(slurryViscosity(none, herschel).name(), "pore");
    EXPECT_EQ(
        slurryViscosity(none, herschel).at(1), herschel.apparent_viscosity(1));
    const std::string error = errorOf(
        [&] { slurryViscosity(entriesOf("viscosity plastic;"), herschel); });
    EXPECT_NE(error.find("has no plastic viscosity"), std::string::npos)
        << error;
}

// ************************************************************************* //
