/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "wallFriction.H"
#include "turbulentTransportModel.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::wallFriction(
    const slurryFields& fields, const label patchi, const scalar speed)
{
    const fvMesh& mesh = fields.mesh();
    const fvPatch& patch = mesh.boundary()[patchi];
    const auto& turbulence = mesh.lookupObject<incompressible::turbulenceModel>(
        turbulenceModel::propertiesName);
    const scalarField voidage(
        fields.displaced() ? mesh.lookupObject<volScalarField>("flowVoidage")
                                 .boundaryField()[patchi]
                                 .patchInternalField()
                           : tmp<scalarField>::New(patch.size(), 1.0));
    const scalarField density(
        mesh.lookupObject<volScalarField>("rho").boundaryField()[patchi]);

    const vectorField normal(patch.nf());
    vectorField gradient(fields.U().boundaryField()[patchi].snGrad());
    gradient -= normal * (normal & gradient);
    gradient += normal ^ vector(0, 0, speed);
    return voidage * density * turbulence.nuEff(patchi) * patch.magSf() *
           gradient;
}


// ************************************************************************* //
