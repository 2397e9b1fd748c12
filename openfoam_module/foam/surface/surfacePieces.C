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


//- Image of the piece of a cell beyond a wall. wall: outward unit normal;
//  distance: of the wall from the centre of the piece, m; angle: of contact,
//  rad. The surface must not lie along the wall
static surfacePieces::neighbour imageOf(
    const vector& normal, const scalar area, const vector& wall,
    const scalar distance, const scalar angle)
{
    vector along(normal - (normal & wall) * wall);
    along /= mag(along);
    const scalar sine = Foam::sin(angle), cosine = Foam::cos(angle);
    const vector contact(sine * along - cosine * wall);
    const vector tangent(cosine * along + sine * wall);
    const scalar lean = (normal & tangent) / (1 + (normal & contact));
    const scalar straight = max(sine + cosine * lean, 0.5 * sine);
    return {
        2 * distance / straight * tangent,
        2 * (normal & contact) * contact - normal, area};
}


} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::surfacePieces::surfacePieces(
    const fvMesh& mesh, std::vector<std::optional<scalar>> contactAngles)
: normal(zeroCells<vector>(mesh, "surface:normal", dimless)),
  centre(zeroCells<vector>(mesh, "surface:centre", dimLength)),
  area(zeroCells<scalar>(mesh, "surface:area", dimArea)),
  angles(std::move(contactAngles))
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


bool Foam::surfacePieces::meets(
    const label celli, const label facei, const scalar reach) const
{
    if (!isCut(celli))
    {
        return false;
    }
    const fvMesh& mesh = normal.mesh();
    const point piece(mesh.cellCentres()[celli] + centre[celli]);
    const point& middle = mesh.faceCentres()[facei];
    bool above = false, below = false;
    for (const label pointi : mesh.faces()[facei])
    {
        const bool isAbove =
            ((middle + reach * (mesh.points()[pointi] - middle) - piece) &
             normal[celli]) > 0;
        above = above || isAbove;
        below = below || !isAbove;
    }
    return above && below;
}


void Foam::surfacePieces::forNeighbours(
    const std::function<void(const label, const neighbour&)>& visit) const
{
    const fvMesh& mesh = normal.mesh();
    const vectorField& centres = mesh.cellCentres();
    const labelUList& owner = mesh.owner();
    const labelUList& neighbours = mesh.neighbour();
    forAll(neighbours, facei)
    {
        const label own = owner[facei];
        const label nei = neighbours[facei];
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


void Foam::surfacePieces::forImages(
    const std::function<void(const label, const neighbour&)>& visit) const
{
    const fvMesh& mesh = normal.mesh();
    forAll(mesh.boundary(), patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        const auto angle =
            angles.empty() ? std::nullopt : angles[std::size_t(patchi)];
        if (!angle)
        {
            continue;
        }
        forAll(patch, i)
        {
            const label celli = patch.faceCells()[i];
            const vector wall(patch.Sf()[i] / patch.magSf()[i]);
            // Where a corner is cut at the wall, the large piece next to it
            // would meet the wall only a little beyond the face. A film on the
            // wall does not meet it
            if (!meets(celli, patch.start() + i, 1.5) ||
                mag(normal[celli] ^ wall) < 1e-3)
            {
                continue;
            }
            const scalar depth =
                (patch.Cf()[i] - mesh.cellCentres()[celli]) & wall;
            // A piece in a corner by the wall says little about the turn there
            const scalar distance =
                max(depth - (centre[celli] & wall), 0.5 * depth);
            visit(
                celli,
                imageOf(normal[celli], area[celli], wall, distance, *angle));
        }
    }
}


// ************************************************************************* //
