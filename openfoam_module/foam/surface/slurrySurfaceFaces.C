/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurrySurface.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::slurrySurface::crossingOf(
    const vector& way, const cellLevel& here, const cellLevel& there,
    const scalar elsewise)
{
    // Depth of either centre below its own cell's level, and where that is
    // not to be trusted below the other's
    const scalar hereByThere = there.depth + (there.normal & way);
    const scalar thereByHere = here.depth - (here.normal & way);
    const scalar lentHere = (1 - here.trust) * there.trust;
    const scalar lentThere = (1 - there.trust) * here.trust;
    if (here.trust + lentHere < VSMALL || there.trust + lentThere < VSMALL)
    {
        return elsewise;
    }
    const scalar depthHere =
        (here.trust * here.depth + lentHere * hereByThere) /
        (here.trust + lentHere);
    const scalar depthThere =
        (there.trust * there.depth + lentThere * thereByHere) /
        (there.trust + lentThere);

    const scalar sense = here.wet > 0.5 ? 1 : -1;
    const scalar from = max(sense * depthHere, scalar(0));
    const scalar to = max(-sense * depthThere, scalar(0));
    return from + to > VSMALL ? from / (from + to) : elsewise;
}


void Foam::slurrySurface::findCrossings()
{
    const vectorField& centres = mesh_.cellCentres();
    const auto level = [this](const label celli)
    {
        return cellLevel{
            wet_[celli], depth_[celli], trust_[celli], levelNormal_[celli]};
    };
    const surfaceScalarField& weights = mesh_.weights();

    forAll(mesh_.neighbour(), facei)
    {
        const label own = mesh_.owner()[facei];
        const label nei = mesh_.neighbour()[facei];
        crossing_[facei] = wet_[own] == wet_[nei]
                               ? 0
                               : crossingOf(
                                     centres[nei] - centres[own], level(own),
                                     level(nei), 1 - weights[facei]);
    }

    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        scalarField& crossing = crossing_.boundaryFieldRef()[patchi];
        crossing = 0;
        if (!patch.coupled())
        {
            continue;
        }
        const vectorField delta(patch.delta());
        const scalarField wet(
            wet_.boundaryField()[patchi].patchNeighbourField());
        const scalarField depth(
            depth_.boundaryField()[patchi].patchNeighbourField());
        const scalarField trust(
            trust_.boundaryField()[patchi].patchNeighbourField());
        const vectorField normal(
            levelNormal_.boundaryField()[patchi].patchNeighbourField());
        forAll(crossing, i)
        {
            const label celli = patch.faceCells()[i];
            if (wet_[celli] != wet[i])
            {
                crossing[i] = crossingOf(
                    delta[i], level(celli),
                    cellLevel{wet[i], depth[i], trust[i], normal[i]},
                    1 - weights.boundaryField()[patchi][i]);
            }
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::surfaceScalarField> Foam::slurrySurface::faceField(
    const word& name, const dimensionSet& dimensions) const
{
    return tmp<surfaceScalarField>::New(
        IOobject(
            name, mesh_.time().timeName(), mesh_, IOobject::NO_READ,
            IOobject::NO_WRITE, false),
        mesh_, dimensionedScalar(dimensions, Zero));
}


Foam::tmp<Foam::surfaceScalarField> Foam::slurrySurface::wetLine() const
{
    tmp<surfaceScalarField> tline(faceField("wetLine", dimless));
    surfaceScalarField& line = tline.ref();

    forAll(mesh_.neighbour(), facei)
    {
        const scalar own = wet_[mesh_.owner()[facei]];
        const scalar nei = wet_[mesh_.neighbour()[facei]];
        line[facei] = crossing_[facei] * own + (1 - crossing_[facei]) * nei;
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatchScalarField& wet = wet_.boundaryField()[patchi];
        const scalarField own(wet.patchInternalField());
        scalarField& share = line.boundaryFieldRef()[patchi];
        if (wet.coupled())
        {
            const scalarField& crossing = crossing_.boundaryField()[patchi];
            share = crossing * own + (1 - crossing) * wet.patchNeighbourField();
        }
        else
        {
            share = own;
        }
    }
    return tline;
}


Foam::tmp<Foam::surfaceScalarField> Foam::slurrySurface::side() const
{
    tmp<surfaceScalarField> tside(faceField("side", dimless));
    surfaceScalarField& side = tside.ref();

    forAll(mesh_.neighbour(), facei)
    {
        side[facei] =
            wet_[mesh_.owner()[facei]] - wet_[mesh_.neighbour()[facei]];
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatchScalarField& wet = wet_.boundaryField()[patchi];
        if (wet.coupled())
        {
            side.boundaryFieldRef()[patchi] =
                wet.patchInternalField() - wet.patchNeighbourField();
        }
    }
    return tside;
}


Foam::tmp<Foam::surfaceScalarField>
Foam::slurrySurface::potential(const vector& g) const
{
    tmp<surfaceScalarField> tpotential(
        faceField("surfacePotential", sqr(dimVelocity)));
    surfaceScalarField& potential = tpotential.ref();
    const vectorField& centres = mesh_.cellCentres();

    forAll(mesh_.neighbour(), facei)
    {
        const point& own = centres[mesh_.owner()[facei]];
        const point& nei = centres[mesh_.neighbour()[facei]];
        potential[facei] = g & (own + crossing_[facei] * (nei - own));
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (patch.coupled())
        {
            potential.boundaryFieldRef()[patchi] =
                g & (patch.Cn() +
                     crossing_.boundaryField()[patchi] * patch.delta());
        }
    }
    return tpotential;
}


// ************************************************************************* //
