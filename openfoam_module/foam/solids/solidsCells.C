/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsCells.H"
#include "averagingMesh.H"
#include "labelIOList.H"
#include "ListOps.H"
#include "pointIOField.H"
#include "untrapped.H"
#include "averaging/mesh/mesh_geometry.hpp"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- How a list of the mesh's files is read
static IOobject meshIO(const word& name, const fvMesh& mesh)
{
    return IOobject(
        name, mesh.facesInstance(), polyMesh::meshSubDir, mesh,
        IOobject::MUST_READ, IOobject::NO_WRITE, false);
}


//- Volumes of the cells when the points are those that the faces were written
//  with; by averaging's own measure, which differs from OpenFOAM's on warped
//  faces
static std::vector<double> writtenVolumes(const fvMesh& mesh)
{
    const pointIOField points(meshIO("points", mesh));
    const millfoam::averaging::MeshGeometry geometry(
        averagingTopology(
            mesh.nPoints(), mesh.nCells(), mesh.faces(), mesh.faceOwner(),
            mesh.faceNeighbour()),
        averagingPoints(points));
    return geometry.volumes();
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::labelList Foam::solidsCells::readLabels(const fvMesh& mesh)
{
    return Pstream::parRun() ? labelIOList(meshIO("cellProcAddressing", mesh))
                             : identity(mesh.nCells());
}


void Foam::solidsCells::checkNumber(
    const fvMesh& mesh, const label expected) const
{
    const label n = returnReduce(mesh.nCells(), sumOp<label>());
    const label last =
        returnReduce(labels_.empty() ? -1 : max(labels_), maxOp<label>());
    if (n != expected || last != expected - 1)
    {
        FatalIOErrorInFunction(dict_)
            << file_ << " holds solids on the " << expected
            << " cells of a mesh but the flow's mesh has " << n
            << " cells, the last labelled " << last << "; expected solids"
            << " averaged on this mesh (foamMeshToH5, millAverage --mesh)"
            << exit(FatalIOError);
    }
}


void Foam::solidsCells::checkVolumes(
    const fvMesh& mesh, const std::vector<double>& expected) const
{
    std::vector<double> found;
    const auto failure = untrapped([&]() { found = writtenVolumes(mesh); });
    if (failure)
    {
        FatalIOErrorInFunction(dict_) << *failure << exit(FatalIOError);
    }

    label first = labelMax;
    scalar volume = 0;
    forAll(labels_, celli)
    {
        const label i = labels_[celli];
        if (i < first && mag(found[celli] - expected[i]) > 1e-6 * expected[i])
        {
            first = i;
            volume = found[celli];
        }
    }

    const label firstOfAll = returnReduce(first, minOp<label>());
    if (firstOfAll != labelMax)
    {
        volume = first == firstOfAll ? volume : 0;
        reduce(volume, sumOp<scalar>());
        FatalIOErrorInFunction(dict_)
            << file_ << " holds solids on a mesh whose cell " << firstOfAll
            << " has the volume " << scalar(expected[firstOfAll])
            << " m3, but the flow's has " << volume << " m3; expected solids"
            << " averaged on this mesh (foamMeshToH5, millAverage --mesh)"
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsCells::solidsCells(
    const dictionary& dict, const fileName& file, const fvMesh& mesh,
    const millfoam::averaging::MeshCells& cells)
: dict_(dict),
  file_(file),
  labels_(readLabels(mesh))
{
    checkNumber(mesh, label(cells.volumes.size()));
    checkVolumes(mesh, cells.volumes);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::solidsCells::pick(
    const millfoam::averaging::SolidsWindow& window, solidsFields& sums) const
{
    sums.clear(labels_.size());
    forAll(labels_, celli)
    {
        const auto i = static_cast<std::size_t>(labels_[celli]);
        const vector u(
            window.velocity[3 * i], window.velocity[3 * i + 1],
            window.velocity[3 * i + 2]);
        sums.add(
            celli, window.solidity[i], u, window.diameter[i],
            window.diameter43[i]);
    }
}


// ************************************************************************* //
