/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "particleDrag.H"
#include "addToRunTimeSelectionTable.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "fvMatrices.H"
#include "fvmSup.H"

#include <stdexcept>

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

Foam::IOobject Foam::fv::particleDrag::fieldIO(const word& name) const
{
    return IOobject(
        name, mesh_.time().timeName(), mesh_, IOobject::NO_READ,
        IOobject::AUTO_WRITE);
}


millfoam::drag::Fluid Foam::fv::particleDrag::readFluid(const word& name) const
{
    const dictionary& dict = coeffs_.subDict(name);
    const millfoam::drag::Fluid fluid{
        dict.get<scalar>("rho"), dict.get<scalar>("mu")};
    if (!(fluid.density > 0 && fluid.viscosity > 0))
    {
        FatalIOErrorInFunction(dict)
            << "rho is " << fluid.density << " and mu is " << fluid.viscosity
            << "; expected both above zero" << exit(FatalIOError);
    }
    return fluid;
}


Foam::label Foam::fv::particleDrag::sampleSolids()
{
    const label uncovered = source_->sample(
        mesh_, solidity_.primitiveFieldRef(), velocity_.primitiveFieldRef(),
        diameter_.primitiveFieldRef());
    solidity_.correctBoundaryConditions();
    velocity_.correctBoundaryConditions();
    diameter_.correctBoundaryConditions();

    return returnReduce(uncovered, sumOp<label>());
}


Foam::tmp<Foam::volScalarField::Internal>
Foam::fv::particleDrag::exchange(const volVectorField& U) const
{
    using millfoam::drag::exchange_coefficient;

    auto tresult = tmp<volScalarField::Internal>::New(
        IOobject(name_ + ":exchange", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimDensity / dimTime, Zero));
    volScalarField::Internal& result = tresult.ref();

    const volScalarField& alpha =
        mesh_.lookupObject<volScalarField>(phaseName_);

    forAll(result, celli)
    {
        const scalar phi = solidity_[celli];
        if (phi <= 0)
            continue;

        const scalar slip = mag(velocity_[celli] - U[celli]);
        const scalar d = diameter_[celli];
        const scalar share = max(scalar(0), min(alpha[celli], scalar(1)));
        const scalar beta =
            share * exchange_coefficient(*law_, phi, slip, d, slurry_) +
            (1 - share) * exchange_coefficient(*law_, phi, slip, d, air_);
        result[celli] = multiplier_ * beta / (1 - phi);
    }
    return tresult;
}


void Foam::fv::particleDrag::report(
    const volVectorField& U, const volScalarField::Internal& exchange) const
{
    const volScalarField& alpha =
        mesh_.lookupObject<volScalarField>(phaseName_);
    const scalarField& volume = mesh_.V();

    scalar largestRe = 0;
    vector force(Zero);
    scalar solids = 0;
    forAll(exchange, celli)
    {
        const scalar phi = solidity_[celli];
        if (phi <= 0)
            continue;

        const vector slip(velocity_[celli] - U[celli]);
        if (alpha[celli] > 0.5)
        {
            largestRe =
                max(largestRe, millfoam::drag::reynolds(
                                   phi, mag(slip), diameter_[celli], slurry_));
        }
        force += exchange[celli] * slip * volume[celli];
        solids += phi * volume[celli];
    }
    reduce(largestRe, maxOp<scalar>());
    reduce(force, sumOp<vector>());
    reduce(solids, sumOp<scalar>());

    Info << type() << " " << name_ << ": solids " << solids
         << " m3, largest particle Re in slurry " << largestRe
         << ", force on the fluid " << force << " N" << endl;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::fv::particleDrag::particleDrag(
    const word& name, const word& modelType, const dictionary& dict,
    const fvMesh& mesh)
: option(name, modelType, dict, mesh),
  law_(nullptr),
  phaseName_(),
  slurry_(),
  air_(),
  multiplier_(1),
  solidity_(
      fieldIO("solidity"), mesh, dimensionedScalar(dimless, Zero),
      extrapolatedCalculatedFvPatchScalarField::typeName),
  velocity_(
      fieldIO("solidsVelocity"), mesh, dimensionedVector(dimVelocity, Zero),
      extrapolatedCalculatedFvPatchVectorField::typeName),
  diameter_(
      fieldIO("solidsDiameter"), mesh, dimensionedScalar(dimLength, Zero),
      extrapolatedCalculatedFvPatchScalarField::typeName),
  sampledIndex_(-1)
{
    fieldNames_.setSize(1, coeffs_.lookupOrDefault<word>("U", "U"));
    applied_.setSize(1, false);

    read(dict);
    source_ = solidsSource::New(coeffs_, mesh);

    Info << "    drag law " << word(std::string(law_->name), false) << " ("
         << std::string(law_->reference).c_str() << "), "
         << source_->description().c_str() << endl;

    const label uncovered = sampleSolids();
    if (uncovered)
    {
        WarningInFunction
            << name << ": " << uncovered << " of "
            << returnReduce(mesh.nCells(), sumOp<label>())
            << " cells lie outside the solids' grid and feel no drag" << endl;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::fv::particleDrag::addSup(
    const volScalarField& rho, fvMatrix<vector>& eqn, const label fieldi)
{
    const volVectorField& U = eqn.psi();

    const bool firstInStep = sampledIndex_ != mesh_.time().timeIndex();
    if (firstInStep || mesh_.changing())
    {
        sampleSolids();
        sampledIndex_ = mesh_.time().timeIndex();
    }

    const tmp<volScalarField::Internal> coefficient(exchange(U));
    if (firstInStep)
    {
        report(U, coefficient());
    }

    eqn += coefficient() * velocity_.internalField();
    eqn -= fvm::Sp(coefficient(), U);
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

    phaseName_ = coeffs_.get<word>("phase");
    slurry_ = readFluid("slurry");
    air_ = readFluid("air");
    multiplier_ = coeffs_.lookupOrDefault<scalar>("multiplier", 1);
    if (!(multiplier_ >= 0))
    {
        FatalIOErrorInFunction(coeffs_)
            << "multiplier is " << multiplier_
            << "; expected a factor on the drag, 0 or above"
            << exit(FatalIOError);
    }

    const word lawName(coeffs_.get<word>("law"));
    std::string reason;
    try
    {
        law_ = &millfoam::drag::find_law(lawName);
    }
    catch (const std::invalid_argument& error)
    {
        reason = error.what();
    }
    if (!reason.empty())
    {
        FatalIOErrorInFunction(coeffs_) << reason << exit(FatalIOError);
    }
    return true;
}


// ************************************************************************* //
