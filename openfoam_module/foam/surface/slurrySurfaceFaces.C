/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurrySurface.H"
#include "surfaceCurvature.H"
#include "zeroFields.H"

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


Foam::tmp<Foam::scalarField>
Foam::slurrySurface::coupledCrossings(const label patchi) const
{
    const fvPatch& patch = mesh_.boundary()[patchi];
    const vectorField delta(patch.delta());
    const scalarField wet(wet_.boundaryField()[patchi].patchNeighbourField());
    const scalarField depth(
        depth_.boundaryField()[patchi].patchNeighbourField());
    const scalarField trust(
        trust_.boundaryField()[patchi].patchNeighbourField());
    const vectorField normal(
        levelNormal_.boundaryField()[patchi].patchNeighbourField());
    auto tcrossings = tmp<scalarField>::New(patch.size(), Zero);
    forAll(delta, i)
    {
        const label celli = patch.faceCells()[i];
        if (wet_[celli] != wet[i])
        {
            tcrossings.ref()[i] = crossingOf(
                delta[i], levelOf(celli),
                {wet[i], depth[i], trust[i], normal[i]},
                1 - mesh_.weights().boundaryField()[patchi][i]);
        }
    }
    return tcrossings;
}


void Foam::slurrySurface::findCrossings()
{
    const vectorField& centres = mesh_.cellCentres();
    forAll(mesh_.neighbour(), facei)
    {
        const label own = mesh_.owner()[facei];
        const label nei = mesh_.neighbour()[facei];
        crossing_[facei] = wet_[own] == wet_[nei]
                               ? 0
                               : crossingOf(
                                     centres[nei] - centres[own], levelOf(own),
                                     levelOf(nei), 1 - mesh_.weights()[facei]);
    }
    forAll(mesh_.boundary(), patchi)
    {
        scalarField& crossing = crossing_.boundaryFieldRef()[patchi];
        crossing = 0;
        if (mesh_.boundary()[patchi].coupled())
        {
            crossing = coupledCrossings(patchi);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::surfaceScalarField> Foam::slurrySurface::wetLine() const
{
    tmp<surfaceScalarField> tline(zeroFaces(mesh_, "wetLine", dimless));
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
    tmp<surfaceScalarField> tside(zeroFaces(mesh_, "side", dimless));
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
        zeroFaces(mesh_, "surfacePotential", sqr(dimVelocity)));
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


Foam::tmp<Foam::surfaceScalarField> Foam::slurrySurface::curvature() const
{
    // Without smoothing the noise of the normals drives currents that grow until
    // a drop of 10 cells a radius has lost half of its pressure
    tmp<volScalarField> tcurvature(cellCurvature(pieces_));
    for (label pass = 0; pass < 2; ++pass)
    {
        smoothAlong(tcurvature.ref(), pieces_);
    }
    return mag(side()) * trustedMean(tcurvature, trust_);
}


// ************************************************************************* //
