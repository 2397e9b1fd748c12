/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "particleDrag.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMatrices.H"
#include "fvmSup.H"
#include "knownEntries.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace fv
{
defineTypeNameAndDebug(particleDrag, 0);
addToRunTimeSelectionTable(option, particleDrag, dictionary);
} // namespace fv
} // namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::dictionary Foam::fv::particleDrag::bedEntries(dictionary dict)
{
    // add() leaves an entry that is there as it is, but not without a warning
    const auto byDefault = [&dict](const word& key, const word& value)
    {
        if (!dict.found(key))
        {
            dict.add(key, value);
        }
    };
    byDefault("inTime", "window");
    byDefault("ledgerCorrection", "no");
    byDefault("uncovered", "warn");
    return dict;
}


Foam::string Foam::fv::particleDrag::who() const
{
    return typeName + " " + name_;
}


const Foam::volScalarField& Foam::fv::particleDrag::phase() const
{
    return mesh_.lookupObject<volScalarField>(phaseName_);
}


Foam::vector Foam::fv::particleDrag::force(
    const volVectorField& U, const volScalarField::Internal& coefficient) const
{
    const vectorField& balls = bed_.velocity().primitiveField();
    return gSum(
        coefficient.field() * (balls - U.primitiveField()) * mesh_.V().field());
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::fv::particleDrag::particleDrag(
    const word& name, const word& modelType, const dictionary& dict,
    const fvMesh& mesh)
: option(name, modelType, dict, mesh),
  drag_(),
  bed_(bedEntries(coeffs_), mesh),
  phaseName_(),
  reported_(-1)
{
    fieldNames_.setSize(1, coeffs_.lookupOrDefault<word>("U", "U"));
    applied_.setSize(1, false);

    particleDrag::read(dict);
    bed_.requireSolids();

    Info << "    " << drag_->description().c_str() << ", "
         << bed_.description().c_str() << endl;
}


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::fv::particleDrag::~particleDrag()
{
    drag_->summary(who());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::fv::particleDrag::addSup(
    const volScalarField&, fvMatrix<vector>& eqn, const label)
{
    const volVectorField& U = eqn.psi();

    bed_.update();
    const volScalarField::Internal coefficient(
        drag_->exchange(bed_, phase(), U) / bed_.voidage().internalField());

    if (reported_ != mesh_.time().timeIndex())
    {
        reported_ = mesh_.time().timeIndex();
        drag_->report(bed_, phase(), U, who());
        Info << who().c_str() << ": force on the fluid "
             << force(U, coefficient) << " N" << endl;
    }

    eqn += coefficient * bed_.velocity().internalField();
    eqn -= fvm::Sp(coefficient, U);
}


void Foam::fv::particleDrag::addSup(fvMatrix<vector>& eqn, const label)
{
    FatalErrorInFunction
        << type() << " " << name_ << ": the equation of " << eqn.psi().name()
        << " has no density; expected a solver such as interFoam, whose"
        << " momentum equation is per volume" << exit(FatalError);
}


bool Foam::fv::particleDrag::read(const dictionary& dict)
{
    if (!option::read(dict))
    {
        return false;
    }

    wordList known({"phase", "slurry", "air", "U"});
    known.append(movingBed::entries());
    known.append(bedDrag::entries());
    refuseMisspelt(coeffs_, known);

    phaseName_ = coeffs_.get<word>("phase");
    drag_.reset(new bedDrag(coeffs_));
    return true;
}


// ************************************************************************* //
