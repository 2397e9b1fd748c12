/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "surfaceFilms.H"
#include "syncTools.H"
#include "wallFvPatch.H"
#include "zeroFields.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Rounds in which cells pass on what walls carry: between a film and its wall
//  lie few cells, if any
constexpr label sweeps = 3;

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::surfaceFilms::findLoose(const volScalarField& wet)
{
    labelList pointWet(mesh_.nPoints(), Zero);
    forAll(wet, celli)
    {
        if (wet[celli] > 0.5)
        {
            UIndirectList<label>(pointWet, mesh_.cellPoints()[celli]) = 1;
        }
    }
    syncTools::syncPointList(mesh_, pointWet, maxEqOp<label>(), label(0));

    forAll(loose_, celli)
    {
        const labelList& points = mesh_.cellPoints()[celli];
        loose_[celli] = std::none_of(
            points.begin(), points.end(),
            [&pointWet](const label p) { return pointWet[p] > 0; });
    }
    loose_.correctBoundaryConditions();
}


Foam::scalarField Foam::surfaceFilms::boundaryCarriers() const
{
    scalarField carriers(mesh_.nFaces() - mesh_.nInternalFaces(), Zero);
    for (const fvPatch& patch : mesh_.boundary())
    {
        const label start = patch.start() - mesh_.nInternalFaces();
        forAll(patch.faceCells(), i)
        {
            carriers[start + i] = patch.coupled()
                                      ? carrier(patch.faceCells()[i])
                                  : isA<wallFvPatch>(patch) ? 1
                                                            : 0;
        }
    }
    syncTools::swapBoundaryFaceList(mesh_, carriers);
    return carriers;
}


Foam::scalar Foam::surfaceFilms::carried(
    const label celli, const levels& cells,
    const scalarField& boundaryCarriers) const
{
    const vector& n = cells.normal[celli];
    const scalar offset = cells.depth[celli] + (n & mesh_.cellCentres()[celli]);
    scalar sum = 0;
    scalar whole = 0;
    for (const label facei : mesh_.cells()[celli])
    {
        const bool owned = mesh_.faceOwner()[facei] == celli;
        const scalar sense = owned ? 1 : -1;
        const scalar down = -sense * (mesh_.faceAreas()[facei] & up_);
        if (down > 0)
        {
            const scalar area = down * cut_.wetShare(facei, n, offset, offset);
            const label outer = facei - mesh_.nInternalFaces();
            const label other = outer >= 0 ? -1
                                : owned    ? mesh_.neighbour()[facei]
                                           : mesh_.owner()[facei];
            sum +=
                area * (outer >= 0 ? boundaryCarriers[outer] : carrier(other));
            whole += area;
        }
    }
    return whole > 0 ? sum / whole : 0;
}


Foam::scalar Foam::surfaceFilms::lowest(const label facei) const
{
    scalar low = GREAT;
    for (const label pointi : mesh_.faces()[facei])
    {
        low = min(low, up_ & mesh_.points()[pointi]);
    }
    return low - (up_ & mesh_.cellCentres()[mesh_.faceOwner()[facei]]);
}


Foam::scalar Foam::surfaceFilms::riseOf(
    const label facei, const scalar way, const content& here,
    const content& there) const
{
    if (here.film <= 0 && there.film <= 0)
    {
        return 0;
    }
    const scalar beyond = way + there.height;
    const scalar edge = lowest(facei);
    const scalar out = here.film * there.loose * max(here.height - edge, 0.0);
    const scalar in = there.film * here.loose * max(beyond - edge, 0.0);
    return min(here.standing, there.standing) * (beyond - here.height) - out +
           in;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::surfaceFilms::surfaceFilms(
    const planeCut& cut, const fvMesh& mesh, const vector& up)
: mesh_(mesh),
  cut_(cut),
  up_(up),
  loose_(zeroCells<scalar>(mesh, "loose", dimless)),
  film_(zeroCells<scalar>(mesh, "film", dimless)),
  standing_(zeroCells<scalar>(mesh, "surface:standing", dimless)),
  height_(zeroCells<scalar>(mesh, "surface:height", dimLength))
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::surfaceFilms::update(const levels& cells)
{
    findLoose(cells.wet);
    film_ = dimensionedScalar(dimless, Zero);
    for (label i = 0; i < sweeps; ++i)
    {
        const scalarField beyond(boundaryCarriers());
        forAll(film_, celli)
        {
            if (loose_[celli] > 0 && cells.share[celli] > 0)
            {
                film_[celli] =
                    cells.share[celli] * carried(celli, cells, beyond);
            }
        }
        film_.correctBoundaryConditions();
    }
    forAll(film_, celli)
    {
        const scalar share = cells.share[celli];
        standing_[celli] = cells.wet[celli] > 0.5 ? 0
                           : loose_[celli] > 0    ? film_[celli]
                                                  : share;
        height_[celli] =
            share > 0 ? cells.depth[celli] / (cells.normal[celli] & up_) : 0;
    }
    loose_ -= film_;
    loose_.correctBoundaryConditions();
    standing_.correctBoundaryConditions();
    height_.correctBoundaryConditions();
}


Foam::tmp<Foam::surfaceScalarField> Foam::surfaceFilms::rise() const
{
    tmp<surfaceScalarField> trise(zeroFaces(mesh_, "filmRise", dimLength));
    surfaceScalarField& rise = trise.ref();
    const vectorField& centres = mesh_.cellCentres();
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const label own = owner[facei];
        const label nei = neighbour[facei];
        rise[facei] = riseOf(
            facei, up_ & (centres[nei] - centres[own]), contentOf(own),
            contentOf(nei));
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (!patch.coupled())
        {
            continue;
        }
        const scalarField way(up_ & patch.delta());
        const auto beyond = [patchi](const volScalarField& field)
        { return field.boundaryField()[patchi].patchNeighbourField(); };
        const scalarField film(beyond(film_));
        const scalarField loose(beyond(loose_));
        const scalarField standing(beyond(standing_));
        const scalarField height(beyond(height_));
        forAll(way, i)
        {
            rise.boundaryFieldRef()[patchi][i] = riseOf(
                patch.start() + i, way[i], contentOf(patch.faceCells()[i]),
                {film[i], loose[i], standing[i], height[i]});
        }
    }
    return trise;
}


// ************************************************************************* //
