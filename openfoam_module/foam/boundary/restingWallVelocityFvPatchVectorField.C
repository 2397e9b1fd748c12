/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "restingWallVelocityFvPatchVectorField.H"
#include "addToRunTimeSelectionTable.H"
#include "fvcMeshPhi.H"
#include "surfaceFields.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::restingWallVelocityFvPatchVectorField::
    restingWallVelocityFvPatchVectorField(
        const fvPatch& patch, const DimensionedField<vector, volMesh>& field)
: fixedValueFvPatchVectorField(patch, field)
{
}


Foam::restingWallVelocityFvPatchVectorField::
    restingWallVelocityFvPatchVectorField(
        const fvPatch& patch, const DimensionedField<vector, volMesh>& field,
        const dictionary& dict)
: fixedValueFvPatchVectorField(patch, field, dict, false)
{
    fvPatchVectorField::operator=(
        dict.found("value") ? vectorField("value", dict, patch.size())
                            : vectorField(patch.size(), Zero));
}


Foam::restingWallVelocityFvPatchVectorField::
    restingWallVelocityFvPatchVectorField(
        const restingWallVelocityFvPatchVectorField& from, const fvPatch& patch,
        const DimensionedField<vector, volMesh>& field,
        const fvPatchFieldMapper& mapper)
: fixedValueFvPatchVectorField(from, patch, field, mapper)
{
}


Foam::restingWallVelocityFvPatchVectorField::
    restingWallVelocityFvPatchVectorField(
        const restingWallVelocityFvPatchVectorField& from)
: fixedValueFvPatchVectorField(from)
{
}


Foam::restingWallVelocityFvPatchVectorField::
    restingWallVelocityFvPatchVectorField(
        const restingWallVelocityFvPatchVectorField& from,
        const DimensionedField<vector, volMesh>& field)
: fixedValueFvPatchVectorField(from, field)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::restingWallVelocityFvPatchVectorField::updateCoeffs()
{
    if (updated())
    {
        return;
    }
    vectorField velocity(size(), Zero);
    if (internalField().mesh().moving())
    {
        const auto& U = static_cast<const volVectorField&>(internalField());
        const scalarField swept(
            patch().patchField<surfaceScalarField, scalar>(fvc::meshPhi(U)));
        velocity = patch().nf() * swept / patch().magSf();
    }
    operator==(velocity);
    fixedValueFvPatchVectorField::updateCoeffs();
}


// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
makePatchTypeField(fvPatchVectorField, restingWallVelocityFvPatchVectorField);
}

// ************************************************************************* //
