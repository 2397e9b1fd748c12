/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "surfaceTransport.H"
#include "slurryShare.H"
#include "syncTools.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::surfaceTransport::sweepPlanes(
    const vectorField& U, const scalar deltaT)
{
    const volVectorField& normal = surface_.normal();
    forAll(normal, celli)
    {
        if (magSqr(normal[celli]) > 0.5)
        {
            from_[celli] = surface_.offset(celli);
            to_[celli] = from_[celli] + (normal[celli] & U[celli]) * deltaT;
        }
    }
}


Foam::scalar
Foam::surfaceTransport::outflowShare(const label celli, const label facei) const
{
    const vector& n = surface_.normal()[celli];
    if (magSqr(n) > 0.5)
    {
        return surface_.planes().wetShare(facei, n, from_[celli], to_[celli]);
    }
    return min(max(alpha_[celli], scalar(0)), scalar(1));
}


void Foam::surfaceTransport::patchShares(
    const label patchi, const surfaceScalarField& phi,
    scalarField& shares) const
{
    const fvPatch& patch = mesh_.boundary()[patchi];
    const scalarField& flow = phi.boundaryField()[patchi];
    const scalarField& outside = alpha_.boundaryField()[patchi];
    const label start = patch.start() - mesh_.nInternalFaces();
    checkInflow(alpha_.boundaryField()[patchi], flow);
    forAll(flow, i)
    {
        const label celli = patch.faceCells()[i];
        if (flow[i] < 0)
        {
            shares[start + i] = outside[i];
        }
        else if (patch.coupled())
        {
            shares[start + i] = outflowShare(celli, patch.start() + i);
        }
        else
        {
            // MULES takes boundary fluxes as they are: only upwind ones are
            // sure to leave the cell within 0 and 1
            shares[start + i] = min(max(alpha_[celli], scalar(0)), scalar(1));
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::surfaceTransport::surfaceTransport(
    const slurrySurface& surface, const volScalarField& alpha)
: surface_(surface),
  alpha_(alpha),
  mesh_(alpha.mesh()),
  from_(mesh_.nCells(), Zero),
  to_(mesh_.nCells(), Zero)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::surfaceScalarField> Foam::surfaceTransport::flux(
    const surfaceScalarField& phi, const vectorField& U)
{
    sweepPlanes(U, mesh_.time().deltaTValue());

    tmp<surfaceScalarField> tslurry(tmp<surfaceScalarField>::New(
        IOobject("alphaPhi", mesh_.time().timeName(), mesh_), phi));
    surfaceScalarField& slurry = tslurry.ref();

    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const label upwind = phi[facei] >= 0 ? owner[facei] : neighbour[facei];
        slurry[facei] *= outflowShare(upwind, facei);
    }

    scalarField shares(mesh_.nFaces() - mesh_.nInternalFaces(), Zero);
    forAll(mesh_.boundary(), patchi)
    {
        patchShares(patchi, phi, shares);
    }
    scalarField others(shares);
    syncTools::swapBoundaryFaceList(mesh_, others);

    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        fvsPatchScalarField& flow = slurry.boundaryFieldRef()[patchi];
        const label start = patch.start() - mesh_.nInternalFaces();
        forAll(flow, i)
        {
            const bool inflow = patch.coupled() && flow[i] < 0;
            flow[i] *= inflow ? others[start + i] : shares[start + i];
        }
    }
    return tslurry;
}


// ************************************************************************* //
