/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

template <class Type>
Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>
Foam::slurrySurface::cellField(
    const word& name, const dimensionSet& dimensions) const
{
    return GeometricField<Type, fvPatchField, volMesh>(
        IOobject(
            name, mesh_.time().timeName(), mesh_, IOobject::NO_READ,
            IOobject::NO_WRITE, false),
        mesh_, dimensioned<Type>("zero", dimensions, Zero),
        zeroGradientFvPatchField<Type>::typeName);
}


template <class Visitor>
void Foam::slurrySurface::forNeighbours(const Visitor& visit) const
{
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const vectorField& centres = mesh_.cellCentres();
    forAll(neighbour, facei)
    {
        const label own = owner[facei];
        const label nei = neighbour[facei];
        const scalar cosine = normal_[own] & normal_[nei];
        if (cosine > 0)
        {
            const vector way(
                centres[nei] - centres[own] + centre_[nei] - centre_[own]);
            visit(own, way, normal_[nei], cosine * area_[nei]);
            visit(nei, -way, normal_[own], cosine * area_[own]);
        }
    }

    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (!patch.coupled())
        {
            continue;
        }
        const vectorField delta(patch.delta());
        const vectorField normals(
            normal_.boundaryField()[patchi].patchNeighbourField());
        const vectorField places(
            centre_.boundaryField()[patchi].patchNeighbourField());
        const scalarField areas(
            area_.boundaryField()[patchi].patchNeighbourField());
        forAll(delta, i)
        {
            const label celli = patch.faceCells()[i];
            const scalar cosine = normal_[celli] & normals[i];
            if (cosine > 0)
            {
                visit(
                    celli, delta[i] + places[i] - centre_[celli], normals[i],
                    cosine * areas[i]);
            }
        }
    }
}


// ************************************************************************* //
