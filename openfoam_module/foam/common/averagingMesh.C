/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "averagingMesh.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

millfoam::averaging::MeshTopology Foam::averagingTopology(
    const label nPoints, const label nCells, const UList<face>& faces,
    const labelUList& owner, const labelUList& neighbour)
{
    millfoam::averaging::MeshTopology result;
    result.points = nPoints;
    result.cells = nCells;
    result.face_begin.push_back(0);
    for (const face& f : faces)
    {
        result.face_points.insert(result.face_points.end(), f.begin(), f.end());
        result.face_begin.push_back(int(result.face_points.size()));
    }
    result.owner.assign(owner.begin(), owner.end());
    result.neighbour.assign(neighbour.begin(), neighbour.end());
    return result;
}


millfoam::averaging::MeshPoints
Foam::averagingPoints(const UList<point>& points)
{
    millfoam::averaging::MeshPoints result;
    result.reserve(points.size());
    for (const point& p : points)
    {
        result.emplace_back(p.x(), p.y(), p.z());
    }
    return result;
}


// ************************************************************************* //
