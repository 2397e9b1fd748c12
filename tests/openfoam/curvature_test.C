/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Description
    surfaceCurvature of pieces that lie exactly on a sphere or a cylinder.

\*---------------------------------------------------------------------------*/

#include <gtest/gtest.h>

#include "smallCase.H"
#include "surfaceCurvature.H"

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

constexpr scalar radius = 0.4;
const point middle(0.51, 0.49, 0.52);

//- Pieces in the cells that lie near the round body about the middle; shape:
//  1 in the directions in which it curves, 0 in others
surfacePieces piecesOf(const fvMesh& mesh, const vector& shape)
{
    surfacePieces result(mesh);
    forAll(result.area, celli)
    {
        const vector out(cmptMultiply(shape, mesh.C()[celli] - middle));
        if (mag(mag(out) - radius) < Foam::cbrt(mesh.V()[celli]))
        {
            result.normal[celli] = out / mag(out);
            result.centre[celli] = (radius / mag(out) - 1) * out;
            result.area[celli] = 1;
        }
    }
    result.correctBoundaryConditions();
    return result;
}

//- Largest difference of the curvature from what is expected, 1/m, in cells
//  whose neighbours have pieces all around
scalar largestError(const surfacePieces& pieces, const scalar expected)
{
    const scalarField found(cellCurvature(pieces)().primitiveField());
    scalar result = 0;
    label cut = 0;
    forAll(found, celli)
    {
        const scalar off = mag(pieces.centre[celli]);
        if (pieces.isCut(celli) &&
            off < 0.5 * Foam::cbrt(pieces.area.mesh().V()[celli]))
        {
            result = max(result, mag(found[celli] - expected));
            ++cut;
        }
        else if (!pieces.isCut(celli))
        {
            EXPECT_EQ(found[celli], 0);
        }
    }
    EXPECT_GT(cut, 20);
    return result;
}

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * Tests * * * * * * * * * * * * * * * * * //

TEST(cellCurvature, ofASphereIsTwoOverItsRadius)
{
    // On a sphere n turns by way/R: the least squares are exact
    smallCase box({{20, 20, 20}});
    EXPECT_LT(
        largestError(piecesOf(box.mesh(), vector(1, 1, 1)), 2 / radius), 1e-9);
}

TEST(cellCurvature, ofACylinderIsOneOverItsRadius)
{
    smallCase box({{20, 20, 3}, {1, 1, 0.15}});
    EXPECT_LT(
        largestError(piecesOf(box.mesh(), vector(1, 1, 0)), 1 / radius), 1e-9);
}

TEST(cellCurvature, ofABubbleIsNegative)
{
    smallCase box({{20, 20, 20}});
    surfacePieces pieces(piecesOf(box.mesh(), vector(1, 1, 1)));
    pieces.normal *= -1;
    EXPECT_LT(largestError(pieces, -2 / radius), 1e-9);
}

TEST(cellCurvature, seesAcrossACyclicPair)
{
    // Walls along x and a cylinder along x: all cells of a row are alike
    smallCase box({{3, 20, 20}, {0.15, 1, 1}, smallBox().map, true});
    EXPECT_LT(
        largestError(piecesOf(box.mesh(), vector(0, 1, 1)), 1 / radius), 1e-9);
    // In one layer the way along x is known through the pair alone
    smallCase layer({{1, 20, 20}, {0.05, 1, 1}, smallBox().map, true});
    label neighbours = 0, cut = 0;
    const surfacePieces pieces(piecesOf(layer.mesh(), vector(0, 1, 1)));
    pieces.forNeighbours(
        [&](const label, const surfacePieces::neighbour& other)
        { neighbours += mag(mag(other.way.x()) - 0.05) < 1e-12; });
    forAll(pieces.area, celli)
    {
        cut += pieces.isCut(celli);
    }
    EXPECT_GT(cut, 20);
    EXPECT_EQ(neighbours, 2 * cut);
}

TEST(smoothAlong, isTheMeanOfACellAndItsNeighboursByTheirAreas)
{
    // A flat surface of one layer of cells, with a cyclic pair along x
    smallCase box({{4, 1, 1}, {1, 1, 1}, smallBox().map, true});
    surfacePieces pieces(box.mesh());
    forAll(pieces.area, celli)
    {
        pieces.normal[celli] = vector(0, 1, 0);
        pieces.area[celli] = celli == 1 ? 3 : 1;
    }
    pieces.correctBoundaryConditions();
    volScalarField values(box.field<scalar>("values", dimless, 0));
    values.primitiveFieldRef() = scalarList{0, 10, 0, 5};
    smoothAlong(values, pieces);
    EXPECT_NEAR(values[0], (0 + 30 + 5) / 5., 1e-14);
    EXPECT_NEAR(values[1], (0 + 30 + 0) / 5., 1e-14);
    EXPECT_NEAR(values[2], (30 + 0 + 5) / 5., 1e-14);
    EXPECT_NEAR(values[3], (0 + 5 + 0) / 3., 1e-14);
}

TEST(smoothAlong, leavesOtherSurfacesOut)
{
    smallCase box({{3, 1, 1}});
    surfacePieces pieces(box.mesh());
    pieces.normal.primitiveFieldRef() =
        vectorField({vector(0, 1, 0), vector(0, -1, 0), vector::zero});
    pieces.area.primitiveFieldRef() = scalarList{1, 1, 0};
    pieces.correctBoundaryConditions();
    volScalarField values(box.field<scalar>("values", dimless, 0));
    values.primitiveFieldRef() = scalarList{1, 2, 3};
    smoothAlong(values, pieces);
    EXPECT_NEAR(values[0], 1, 1e-14);
    EXPECT_NEAR(values[1], 2, 1e-14);
    EXPECT_NEAR(values[2], 3, 1e-14);
}

TEST(trustedMean, countsCellsByTheirTrust)
{
    smallCase box({{3, 1, 1}});
    volScalarField values(box.field<scalar>("values", dimless, 0));
    volScalarField trust(box.field<scalar>("trust", dimless, 0));
    values.primitiveFieldRef() = scalarList{2, 4, 7};
    trust.primitiveFieldRef() = scalarList{1, 0.5, 0};
    surfaceScalarField mean(trustedMean(values, trust));
    EXPECT_NEAR(mean[0], 4.0 / 1.5, 1e-14);
    EXPECT_NEAR(mean[1], 4, 1e-14);
    trust = dimensionedScalar(dimless, Zero);
    mean = trustedMean(values, trust);
    EXPECT_EQ(mean[0], 0);
}

// ************************************************************************* //
