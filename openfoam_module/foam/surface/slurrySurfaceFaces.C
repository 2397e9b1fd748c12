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
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const label own = owner[facei];
        const label nei = neighbour[facei];
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

    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const scalar own = wet_[owner[facei]];
        const scalar nei = wet_[neighbour[facei]];
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

    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        side[facei] = wet_[owner[facei]] - wet_[neighbour[facei]];
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

    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    forAll(neighbour, facei)
    {
        const point& own = centres[owner[facei]];
        const point& nei = centres[neighbour[facei]];
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


Foam::tmp<Foam::volScalarField> Foam::slurrySurface::smoothCurvature() const
{
    // Without smoothing the noise of the normals drives currents that grow until
    // a drop of 10 cells a radius has lost half of its pressure
    const auto smooth = [this](volScalarField& values)
    {
        smoothAlong(values, pieces_);
        smoothAlong(values, pieces_);
    };
    tmp<volScalarField> tcurvature(cellCurvature(pieces_));
    volScalarField& curvature = tcurvature.ref();
    smooth(curvature);
    // Of a wave with k h rad a cell the differences of the normals take (k h)^2/3
    // and the smoothing 2 (k h)^2/3: in a slice this gives both back. Where cells
    // of the surface have four neighbours, 0.13 (k h)^2 stays
    volScalarField smoother("surface:smoother", curvature);
    smooth(smoother);
    curvature += 1.5 * (curvature - smoother);
    return tcurvature;
}


Foam::tmp<Foam::surfaceScalarField> Foam::slurrySurface::curvature() const
{
    if (!curvature_.valid())
    {
        curvature_ = smoothCurvature();
    }
    return mag(side()) * trustedMean(curvature_(), trust_);
}


// ************************************************************************* //
