/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "superficialInletVelocityFvPatchVectorField.H"
#include "addToRunTimeSelectionTable.H"
#include "Constant.H"
#include "fvcMeshPhi.H"
#include "surfaceFields.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Local Data  * * * * * * * * * * * * * * * //

namespace Foam
{

//- Field of the voidage in slurryFoam
static const word usualVoidage_("flowVoidage");

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::superficialInletVelocityFvPatchVectorField::
    superficialInletVelocityFvPatchVectorField(
        const fvPatch& patch, const DimensionedField<vector, volMesh>& field)
: fixedValueFvPatchVectorField(patch, field),
  rate_(nullptr),
  voidageName_(usualVoidage_)
{
}


Foam::superficialInletVelocityFvPatchVectorField::
    superficialInletVelocityFvPatchVectorField(
        const fvPatch& patch, const DimensionedField<vector, volMesh>& field,
        const dictionary& dict)
: fixedValueFvPatchVectorField(patch, field, dict, false),
  rate_(Function1<scalar>::New("volumetricFlowRate", dict)),
  voidageName_(dict.lookupOrDefault<word>("voidage", usualVoidage_))
{
    if (dict.found("value"))
    {
        fvPatchVectorField::operator=(vectorField("value", dict, patch.size()));
    }
    else
    {
        evaluate(Pstream::commsTypes::blocking);
    }
}


Foam::superficialInletVelocityFvPatchVectorField::
    superficialInletVelocityFvPatchVectorField(
        const superficialInletVelocityFvPatchVectorField& from,
        const fvPatch& patch, const DimensionedField<vector, volMesh>& field,
        const fvPatchFieldMapper& mapper)
: fixedValueFvPatchVectorField(from, patch, field, mapper),
  rate_(from.rate_.clone()),
  voidageName_(from.voidageName_)
{
}


Foam::superficialInletVelocityFvPatchVectorField::
    superficialInletVelocityFvPatchVectorField(
        const superficialInletVelocityFvPatchVectorField& from)
: fixedValueFvPatchVectorField(from),
  rate_(from.rate_.clone()),
  voidageName_(from.voidageName_)
{
}


Foam::superficialInletVelocityFvPatchVectorField::
    superficialInletVelocityFvPatchVectorField(
        const superficialInletVelocityFvPatchVectorField& from,
        const DimensionedField<vector, volMesh>& field)
: fixedValueFvPatchVectorField(from, field),
  rate_(from.rate_.clone()),
  voidageName_(from.voidageName_)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::superficialInletVelocityFvPatchVectorField::constantRate() const
{
    return isA<Function1Types::Constant<scalar>>(rate_());
}


void Foam::superficialInletVelocityFvPatchVectorField::updateCoeffs()
{
    if (updated())
    {
        return;
    }
    const scalar rate = rate_->value(db().time().timeOutputValue());
    if (!(rate >= 0))
    {
        FatalErrorInFunction << "patch " << patch().name() << " of "
                             << internalField().objectPath()
                             << ": volumetricFlowRate is " << rate
                             << " m3/s; expected what enters, 0 or more"
                             << exit(FatalError);
    }
    const scalar superficial = rate / gSum(patch().magSf());
    scalarField voidage(size(), 1);
    if (db().foundObject<volScalarField>(voidageName_))
    {
        voidage =
            patch().lookupPatchField<volScalarField, scalar>(voidageName_);
    }
    // Without balls there is no such field; at its start a flow has not made it
    else if (
        voidageName_ != usualVoidage_ &&
        db().time().timeIndex() > db().time().startTimeIndex())
    {
        FatalErrorInFunction
            << "patch " << patch().name() << " of "
            << internalField().objectPath() << ": voidage is " << voidageName_
            << ", and there is no such field; expected " << usualVoidage_
            << ", that of slurryFoam, or one of "
            << db().names<volScalarField>() << exit(FatalError);
    }
    scalarField outwards(-superficial / voidage);
    if (internalField().mesh().moving())
    {
        const auto& U = static_cast<const volVectorField&>(internalField());
        outwards +=
            patch().patchField<surfaceScalarField, scalar>(fvc::meshPhi(U)) /
            patch().magSf();
    }
    operator==(patch().nf() * outwards);
    fixedValueFvPatchVectorField::updateCoeffs();
}


void Foam::superficialInletVelocityFvPatchVectorField::write(Ostream& os) const
{
    fvPatchVectorField::write(os);
    rate_->writeData(os);
    os.writeEntryIfDifferent<word>("voidage", usualVoidage_, voidageName_);
    writeEntry("value", os);
}


// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
makePatchTypeField(
    fvPatchVectorField, superficialInletVelocityFvPatchVectorField);
}

// ************************************************************************* //
