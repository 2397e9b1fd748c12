/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "surfaceCurvature.H"
#include "surfaceInterpolate.H"
#include "zeroFields.H"

#include <Eigen/Dense>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

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
        inverse[i] = inverse[i] > 0.05 ? 1 / inverse[i] : 0;
    }
    const Eigen::Matrix3d& vectors = solver.eigenvectors();
    return (right * vectors * inverse.asDiagonal() * vectors.transpose())
        .trace();
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField> Foam::cellCurvature(const surfacePieces& pieces)
{
    const fvMesh& mesh = pieces.normal.mesh();
    symmTensorField ways(mesh.nCells(), Zero);
    tensorField turns(mesh.nCells(), Zero);
    pieces.forNeighbours(
        [&](const label celli, const surfacePieces::neighbour& other)
        {
            const scalar square = max(magSqr(other.way), VSMALL);
            ways[celli] += sqr(other.way) / square;
            turns[celli] +=
                (other.normal - pieces.normal[celli]) * other.way / square;
        });

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
