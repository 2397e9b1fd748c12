/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "surfaceCurvature.H"
#include "surfaceInterpolate.H"
#include "zeroFields.H"

#include <Eigen/Dense>
#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Area of a piece, over the cell's volume^(2/3), from which on its neighbours
//  count it whole
constexpr scalar smallShare = 0.03;

//- Sum of the squared cosines of the ways to the neighbours with a direction,
//  from which on the direction counts whole
constexpr scalar fewWays = 0.05;

//- trace(b m^-1), with m singular along directions without neighbours
scalar traceOfQuotient(const tensor& b, const symmTensor& m)
{
    Eigen::Matrix3d matrix, right;
    matrix << m.xx(), m.xy(), m.xz(), m.xy(), m.yy(), m.yz(), m.xz(), m.yz(),
        m.zz();
    right << b.xx(), b.xy(), b.xz(), b.yx(), b.yy(), b.yz(), b.zx(), b.zy(),
        b.zz();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    Eigen::Vector3d inverse = solver.eigenvalues();
    for (int i = 0; i < 3; ++i)
    {
        // Directions in which hardly any neighbour lies tell nothing
        const double part = std::clamp(inverse[i] / fewWays, 0.0, 1.0);
        inverse[i] = part > 0 ? part * part * (3 - 2 * part) / inverse[i] : 0.0;
    }
    const Eigen::Matrix3d& vectors = solver.eigenvectors();
    return (right * vectors * inverse.asDiagonal() * vectors.transpose())
        .trace();
}

//- Adds to the sums of cells what their neighbours on a coupled patch have
void addCoupled(
    const label patchi, const volScalarField& values,
    const surfacePieces& pieces, scalarField& weights, scalarField& sums)
{
    const fvPatchScalarField& patch = values.boundaryField()[patchi];
    if (!patch.coupled())
    {
        return;
    }
    const scalarField others(patch.patchNeighbourField());
    const vectorField normals(
        pieces.normal.boundaryField()[patchi].patchNeighbourField());
    const scalarField areas(
        pieces.area.boundaryField()[patchi].patchNeighbourField());
    forAll(others, i)
    {
        const label celli = patch.patch().faceCells()[i];
        const scalar weight =
            max(pieces.normal[celli] & normals[i], scalar(0)) * areas[i];
        weights[celli] += weight;
        sums[celli] += weight * others[i];
    }
}


} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField> Foam::cellCurvature(const surfacePieces& pieces)
{
    const fvMesh& mesh = pieces.normal.mesh();
    symmTensorField ways(mesh.nCells(), Zero);
    tensorField turns(mesh.nCells(), Zero);
    const scalarField& volume = mesh.V();
    const auto add =
        [&](const label celli, const surfacePieces::neighbour& other)
    {
        // Small pieces by their area: one that appears or goes changes nothing
        // at once
        const scalar small = smallShare * cbrt(sqr(volume[celli]));
        const vector& n = pieces.normal[celli];
        const vector along(other.way - n * (n & other.way));
        const scalar weight =
            min(other.area / small, scalar(1)) / max(magSqr(other.way), VSMALL);
        ways[celli] += weight * sqr(along);
        turns[celli] += weight * (other.normal - n) * along;
    };
    pieces.forNeighbours(add);
    pieces.forImages(add);

    tmp<volScalarField> tcurvature(
        zeroCells<scalar>(mesh, "cellCurvature", dimless / dimLength));
    volScalarField& curvature = tcurvature.ref();
    forAll(curvature, celli)
    {
        if (pieces.isCut(celli))
        {
            curvature[celli] = traceOfQuotient(turns[celli], ways[celli]);
        }
    }
    curvature.correctBoundaryConditions();
    return tcurvature;
}


void Foam::smoothAlong(volScalarField& values, const surfacePieces& pieces)
{
    const fvMesh& mesh = values.mesh();
    scalarField weights(pieces.area.primitiveField());
    scalarField sums(weights * values.primitiveField());
    const auto add = [&](const label to, const label from, const scalar cosine)
    {
        weights[to] += cosine * pieces.area[from];
        sums[to] += cosine * pieces.area[from] * values[from];
    };
    const labelUList& owner = mesh.owner();
    const labelUList& neighbour = mesh.neighbour();
    forAll(neighbour, facei)
    {
        const label own = owner[facei];
        const label nei = neighbour[facei];
        const scalar cosine =
            max(pieces.normal[own] & pieces.normal[nei], scalar(0));
        add(own, nei, cosine);
        add(nei, own, cosine);
    }
    forAll(mesh.boundary(), patchi)
    {
        addCoupled(patchi, values, pieces, weights, sums);
    }
    forAll(values, celli)
    {
        if (pieces.isCut(celli))
        {
            values[celli] = sums[celli] / max(weights[celli], VSMALL);
        }
    }
    values.correctBoundaryConditions();
}


Foam::tmp<Foam::surfaceScalarField>
Foam::trustedMean(const volScalarField& values, const volScalarField& trust)
{
    const auto middle = [](const volScalarField& field)
    {
        return surfaceInterpolationScheme<scalar>::interpolate(
            field, tmp<surfaceScalarField>::New(
                       IOobject("half", field.time().timeName(), field.mesh()),
                       field.mesh(), dimensionedScalar("half", dimless, 0.5)));
    };
    return middle(trust * values) /
           max(middle(trust), dimensionedScalar("none", dimless, VSMALL));
}


// ************************************************************************* //
