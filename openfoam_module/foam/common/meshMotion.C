/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshMotion.H"
#include "averagingMesh.H"
#include "fvMesh.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshMotion::meshMotion(const fvMesh& mesh)
: mesh_(mesh)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

millfoam::averaging::MeshGeometry Foam::meshMotion::begin()
{
    begin_ = mesh_.points();
    return millfoam::averaging::MeshGeometry(
        averagingTopology(
            mesh_.nPoints(), mesh_.nCells(), mesh_.faces(), mesh_.faceOwner(),
            mesh_.faceNeighbour()),
        averagingPoints(mesh_.points()));
}


std::optional<Eigen::Isometry3d> Foam::meshMotion::place() const
{
    static_assert(sizeof(point) == 3 * sizeof(double), "points are doubles");
    using Points = Eigen::Map<const Eigen::Matrix3Xd>;
    const pointField& now = mesh_.points();
    const Points from(begin_.cdata()->cdata(), 3, begin_.size());
    const Points to(now.cdata()->cdata(), 3, now.size());

    Eigen::Isometry3d motion;
    motion.matrix() = Eigen::umeyama(from, to, false);
    const scalar off =
        ((motion.linear() * from).colwise() + motion.translation() - to)
            .cwiseAbs()
            .maxCoeff();
    // Round-off of the points, relative to the size of the mesh
    const scalar size = to.cwiseAbs().maxCoeff();
    return off < 1e-10 * size ? std::optional(motion) : std::nullopt;
}


// ************************************************************************* //
