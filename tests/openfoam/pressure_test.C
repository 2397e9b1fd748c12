/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    sharpPressure: fluids at rest, drops, and uniform velocities and
    accelerations, of which the answer is known.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include <memory>

#include "fixedFluxPressureFvPatchScalarField.H"
#include "sharpPressure.H"
#include "slurryShares.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar slurryDensity = 1239;
constexpr scalar airDensity = 1.2;

//- A surface in a box and the pressure that sees it
class pressureCase : public smallCase
{
    public:
    volScalarField alpha;
    volScalarField p_rgh;
    std::unique_ptr<slurrySurface> surface;
    std::unique_ptr<sharpPressure> pressure;

    explicit pressureCase(const smallBox& box)
    : smallCase(box),
      alpha(field<scalar>("alpha.slurry", dimless, 0)),
      p_rgh(field<scalar>("p_rgh", dimPressure, 0, "fixedFluxPressure"))
    {
        for (fvPatchScalarField& patch : p_rgh.boundaryFieldRef())
        {
            if (isA<fixedFluxPressureFvPatchScalarField>(patch))
            {
                refCast<fixedFluxPressureFvPatchScalarField>(patch)
                    .updateSnGrad(scalarField(patch.size(), Zero));
            }
        }
    }

    //- Find the surface of alpha
    void see(const vector& g, const scalar tension)
    {
        surface.reset(new slurrySurface(alpha, g));
        pressure.reset(new sharpPressure(
            *surface, p_rgh, dimensionedVector("value", dimAcceleration, g),
            dimensionedScalar("value", dimDensity, slurryDensity),
            dimensionedScalar("value", dimDensity, airDensity),
            dimensionedScalar("value", dimForce / dimLength, tension)));
        pressure->update(p_rgh, mixture());
    }

    //- p_rgh of a wet and of a dry cell
    void setPressure(const scalar wet, const scalar dry)
    {
        forAll(p_rgh, celli)
        {
            p_rgh[celli] = surface->wet()[celli] > 0.5 ? wet : dry;
        }
        p_rgh.correctBoundaryConditions();
    }

    //- Density of the blend, kg/m3
    volScalarField mixture() const
    {
        return volScalarField(
            "rho",
            dimensionedScalar("value", dimDensity, airDensity) +
                alpha * dimensionedScalar(
                            "value", dimDensity, slurryDensity - airDensity));
    }
};

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(sharpPressure, aPoolAtRestIsInBalanceAtEveryFace)
{
    pressureCase box({{8, 8, 3}, {1, 1, 0.4}, skewed});
    const scalar height = 0.5371;
    fillBelow(box.alpha, vector(0, 1, 0), height);
    box.see(gravity, 0);
    // p = rho g & (x - x_s): p_rgh is one value in either fluid
    box.setPressure(9.81 * slurryDensity * height, 9.81 * airDensity * height);

    const surfaceScalarField& jump = box.pressure->jump();
    forAll(box.mesh().neighbour(), facei)
    {
        const scalar rise = box.p_rgh[box.mesh().neighbour()[facei]] -
                            box.p_rgh[box.mesh().owner()[facei]];
        EXPECT_NEAR(rise + jump[facei], 0, 1e-8);
    }
    EXPECT_LT(gMax(mag(box.pressure->skewSlope()().primitiveField())), 1e-7);

    const volScalarField p(box.pressure->staticPressure());
    forAll(p, celli)
    {
        const scalar y = box.mesh().C()[celli].y();
        EXPECT_NEAR(
            p[celli],
            9.81 * (y < height ? slurryDensity : airDensity) * (height - y),
            1e-8);
    }
}

TEST(sharpPressure, slopesGoWithTheDensitiesOnBothSides)
{
    // p_rgh as both fluids accelerate alike: its slope is A times the density.
    // Across a face the slope along the skewness is that of the line's density
    pressureCase box({{8, 10, 8}, {1, 1, 1}, skewed});
    const fvMesh& mesh = box.mesh();
    const scalar height = 0.7371, A = 2;
    fillBelow(box.alpha, vector(0, 1, 0), height);
    box.see(gravity, 0);
    forAll(box.p_rgh, celli)
    {
        box.p_rgh[celli] = box.pressure->density()[celli] *
                           (A * (mesh.C()[celli].y() - height) + 9.81 * height);
    }
    box.p_rgh.correctBoundaryConditions();

    // Known are cells inside whose lines to dry ones are mostly wet
    const surfaceScalarField line(box.surface->wetLine());
    labelHashSet other(atBoundary(mesh));
    forAll(mesh.neighbour(), facei)
    {
        if (line[facei] > 0 && line[facei] < 0.5)
        {
            other.insert(mesh.owner()[facei]);
            other.insert(mesh.neighbour()[facei]);
        }
    }
    const surfaceScalarField found(box.pressure->skewSlope());
    label crossed = 0;
    forAll(mesh.neighbour(), facei)
    {
        if (!other.found(mesh.owner()[facei]) &&
            !other.found(mesh.neighbour()[facei]))
        {
            const scalar density =
                airDensity + line[facei] * (slurryDensity - airDensity);
            EXPECT_NEAR(
                found[facei],
                mesh.nonOrthCorrectionVectors()[facei].y() * A * density, 1e-7);
            crossed += line[facei] > 0 && line[facei] < 1;
        }
    }
    EXPECT_GT(crossed, 5);
}

TEST(sharpPressure, aCellThatChangesSidesKeepsItsStaticPressure)
{
    pressureCase box({{2, 8, 2}, {1, 1, 1}});
    fillBelow(box.alpha, vector(0, 1, 0), 0.54);
    box.see(gravity, 0);
    box.setPressure(9.81 * slurryDensity * 0.54, 9.81 * airDensity * 0.54);
    const scalarField before(box.pressure->staticPressure()().primitiveField());
    const scalarField wet(box.surface->wet().primitiveField());

    fillBelow(box.alpha, vector(0, 1, 0), 0.58);
    box.surface->reconstruct();
    box.surface->locate();
    box.pressure->update(box.p_rgh, box.mixture());

    EXPECT_EQ(sum(box.surface->wet().primitiveField() - wet), 4);
    const scalarField after(box.pressure->staticPressure()().primitiveField());
    EXPECT_LT(max(mag(after - before)), 1e-8);
}

TEST(sharpPressure, aDropHasThePressureOfItsCurvature)
{
    const scalar radius = 0.33, tension = 0.07;
    pressureCase box({{14, 14, 14}, {1, 1, 1}});
    fillWhere(
        box.alpha, 12,
        [=](const point& p)
        { return magSqr(p - point(0.5, 0.51, 0.49)) < sqr(radius); });
    box.see(vector::zero, tension);

    const surfaceScalarField side(box.surface->side());
    scalar total = 0, crossed = 0;
    forAll(side, facei)
    {
        // Positive from slurry to air: what the pressure falls by
        total += side[facei] * box.pressure->jump()[facei];
        crossed += mag(side[facei]);
        EXPECT_TRUE(side[facei] != 0 || box.pressure->jump()[facei] == 0);
    }
    EXPECT_NEAR(
        total / crossed, 2 * tension / radius, 0.05 * 2 * tension / radius);
}

TEST(sharpPressure, uniformVelocityComesBackFromItsFlux)
{
    pressureCase box({{8, 8, 3}, {1, 1, 0.4}, skewed});
    fillBelow(box.alpha, unit(vector(0.3, 0.9, 0.1)), 0.5);
    box.see(gravity, 0);
    const vector U(0.3, -0.2, 0.1);
    const volVectorField velocity(
        box.field<vector>("velocity", dimVelocity, U, "calculated"));

    const surfaceScalarField flux(box.pressure->flux(velocity));
    EXPECT_LT(
        gMax(mag(flux - (dimensionedVector("value", dimVelocity, U) &
                         box.mesh().Sf()))()
                 .primitiveField()),
        1e-15);
    const volVectorField back(box.pressure->reconstruct(flux));
    for (const vector& found : back)
    {
        EXPECT_LT(mag(found - U), 1e-9);
    }
}

TEST(sharpPressure, fluxAndReconstructionAreAdjointInKineticEnergy)
{
    // Without a surface all weights are those of lines: for any flux q and any
    // velocity u, the mass on the lines times q times flux(u) is the cells'
    // A u & reconstruct(q), A being the sum of mass S S
    pressureCase box({{5, 4, 3}, {1, 1, 0.4}, skewed});
    box.alpha = 1;
    box.alpha.correctBoundaryConditions();
    box.see(gravity, 0);
    const fvMesh& mesh = box.mesh();
    volVectorField u(box.field<vector>("u", dimVelocity, vector::zero));
    forAll(u, celli)
    {
        u[celli] = vector(
            std::sin(celli), std::cos(2.3 * celli), std::sin(0.7 * celli));
    }
    u.correctBoundaryConditions();
    surfaceScalarField q(box.pressure->flux(u));
    forAll(q, facei)
    {
        q[facei] = 0.01 * std::sin(3.1 * facei);
    }
    for (fvsPatchScalarField& patch : q.boundaryFieldRef())
    {
        patch = 0;
    }

    const surfaceScalarField flux(box.pressure->flux(u));
    const vectorField back(box.pressure->reconstruct(q)().primitiveField());
    const surfaceScalarField length(
        1 / (mesh.nonOrthDeltaCoeffs() * mesh.magSf()));
    scalar onFaces = 0;
    tensorField areas(mesh.nCells(), Zero);
    forAll(mesh.neighbour(), facei)
    {
        const scalar w = mesh.weights()[facei] * length[facei];
        const tensor SS(mesh.Sf()[facei] * mesh.Sf()[facei]);
        onFaces += slurryDensity * length[facei] * q[facei] * flux[facei];
        areas[mesh.owner()[facei]] += slurryDensity * w * SS;
        areas[mesh.neighbour()[facei]] +=
            slurryDensity * (length[facei] - w) * SS;
    }
    forAll(mesh.boundary(), patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        forAll(patch, i)
        {
            const vector& S = patch.Sf()[i];
            areas[patch.faceCells()[i]] +=
                slurryDensity * length.boundaryField()[patchi][i] * S * S;
        }
    }
    scalar inCells = 0;
    forAll(u, celli)
    {
        inCells += (areas[celli] & back[celli]) & u[celli];
    }
    EXPECT_GT(mag(onFaces), 1e-3);
    EXPECT_NEAR(inCells, onFaces, 1e-9 * mag(onFaces));
}

TEST(sharpPressure, oneAccelerationOfBothFluidsIsOneAtTheFaces)
{
    // Cut cells are wet, so that no dry cell holds slurry
    pressureCase box({{3, 8, 2}, {1, 1, 1}});
    fillBelow(box.alpha, vector(0, 1, 0), 0.605);
    box.see(gravity, 0);
    const vector a(0.3, 2, -0.1);
    const volVectorField force(
        box.pressure->density() *
        dimensionedVector("value", dimAcceleration, a));

    const surfaceScalarField found(box.pressure->accelerationFlux(force));
    const surfaceScalarField& faceDensity = box.pressure->faceDensity();
    const surfaceScalarField rate(box.pressure->faceRate(
        box.pressure->density() / dimensionedScalar("value", dimTime, 1)));
    bool crossed = false;
    forAll(found, facei)
    {
        EXPECT_NEAR(found[facei], a & box.mesh().Sf()[facei], 1e-14);
        EXPECT_NEAR(rate[facei], 1, 1e-13);
        crossed = crossed || (faceDensity[facei] > 1.1 * airDensity &&
                              faceDensity[facei] < 0.9 * slurryDensity);
    }
    EXPECT_TRUE(crossed);
}

// ************************************************************************* //
