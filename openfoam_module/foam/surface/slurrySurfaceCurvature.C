/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurrySurface.H"

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


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::surfaceScalarField> Foam::slurrySurface::curvature() const
{
    // Of each cell: the surface divergence of the normals, by least squares
    symmTensorField ways(mesh_.nCells(), Zero);
    tensorField turns(mesh_.nCells(), Zero);
    forNeighbours(
        [&](const label celli, const vector& way, const vector& normal,
            const scalar)
        {
            const scalar square = max(magSqr(way), VSMALL);
            ways[celli] += sqr(way) / square;
            turns[celli] += (normal - normal_[celli]) * way / square;
        });

    volScalarField kappa(cellField<scalar>("kappa", dimless / dimLength));
    forAll(kappa, celli)
    {
        if (isCut(celli))
        {
            kappa[celli] = traceOfQuotient(turns[celli], ways[celli]);
        }
    }
    kappa.correctBoundaryConditions();

    tmp<surfaceScalarField> tcurvature(
        faceField("curvature", dimless / dimLength));
    surfaceScalarField& curvature = tcurvature.ref();
    const auto mean = [](const scalar a, const scalar trustA, const scalar b,
                         const scalar trustB)
    { return (trustA * a + trustB * b) / max(trustA + trustB, VSMALL); };
    forAll(mesh_.neighbour(), facei)
    {
        const label own = mesh_.owner()[facei];
        const label nei = mesh_.neighbour()[facei];
        if (wet_[own] != wet_[nei])
        {
            curvature[facei] =
                mean(kappa[own], trust_[own], kappa[nei], trust_[nei]);
        }
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (!patch.coupled())
        {
            continue;
        }
        const scalarField other(
            kappa.boundaryField()[patchi].patchNeighbourField());
        const scalarField trust(
            trust_.boundaryField()[patchi].patchNeighbourField());
        const scalarField wet(
            wet_.boundaryField()[patchi].patchNeighbourField());
        forAll(patch, i)
        {
            const label celli = patch.faceCells()[i];
            if (wet_[celli] != wet[i])
            {
                curvature.boundaryFieldRef()[patchi][i] =
                    mean(kappa[celli], trust_[celli], other[i], trust[i]);
            }
        }
    }
    return tcurvature;
}


// ************************************************************************* //
