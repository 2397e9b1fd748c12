/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "surfacePieces.H"
#include "zeroFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Calls visit for the cells inside coupled patches and their neighbours
//  beyond
static void forCoupled(
    const surfacePieces& pieces,
    const std::function<void(label, const surfacePieces::neighbour&)>& visit)
{
    forAll(pieces.normal.boundaryField(), patchi)
    {
        const fvPatch& patch = pieces.normal.mesh().boundary()[patchi];
        if (!patch.coupled())
        {
            continue;
        }
        const vectorField delta(patch.delta());
        const vectorField normals(
            pieces.normal.boundaryField()[patchi].patchNeighbourField());
        const vectorField centres(
            pieces.centre.boundaryField()[patchi].patchNeighbourField());
        const scalarField areas(
            pieces.area.boundaryField()[patchi].patchNeighbourField());
        forAll(delta, i)
        {
            const label celli = patch.faceCells()[i];
            const scalar cosine = pieces.normal[celli] & normals[i];
            if (cosine > 0)
            {
                visit(
                    celli, {delta[i] + centres[i] - pieces.centre[celli],
                            normals[i], cosine * areas[i]});
            }
        }
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::surfacePieces::surfacePieces(const fvMesh& mesh)
: normal(zeroCells<vector>(mesh, "surface:normal", dimless)),
  centre(zeroCells<vector>(mesh, "surface:centre", dimLength)),
  area(zeroCells<scalar>(mesh, "surface:area", dimArea))
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::surfacePieces::remove(const label celli)
{
    normal[celli] = Zero;
    centre[celli] = Zero;
    area[celli] = 0;
}


void Foam::surfacePieces::correctBoundaryConditions()
{
    normal.correctBoundaryConditions();
    centre.correctBoundaryConditions();
    area.correctBoundaryConditions();
}


void Foam::surfacePieces::forNeighbours(
    const std::function<void(const label, const neighbour&)>& visit) const
{
    const fvMesh& mesh = normal.mesh();
    const vectorField& centres = mesh.cellCentres();
    forAll(mesh.neighbour(), facei)
    {
        const label own = mesh.owner()[facei];
        const label nei = mesh.neighbour()[facei];
        const scalar cosine = normal[own] & normal[nei];
        if (cosine > 0)
        {
            const vector way(
                centres[nei] - centres[own] + centre[nei] - centre[own]);
            visit(own, {way, normal[nei], cosine * area[nei]});
            visit(nei, {-way, normal[own], cosine * area[own]});
        }
    }
    forCoupled(*this, visit);
}


// ************************************************************************* //
