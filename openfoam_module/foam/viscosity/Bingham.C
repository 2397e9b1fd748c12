/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "Bingham.H"
#include "addToRunTimeSelectionTable.H"
#include "surfaceFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace viscosityModels
{
defineTypeNameAndDebug(Bingham, 0);
addToRunTimeSelectionTable(viscosityModel, Bingham, dictionary);
} // namespace viscosityModels
} // namespace Foam

const Foam::Enum<Foam::viscosityModels::Bingham::regularisation>
    Foam::viscosityModels::Bingham::regularisationNames_({
        {regularisation::biviscosity, "biviscosity"},
        {regularisation::Papanastasiou, "Papanastasiou"},
    });


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

namespace
{

// Entry that must be there and above zero (or at least zero)
Foam::scalar readBounded(
    const Foam::dictionary& dict, const Foam::word& key, const bool zeroAllowed)
{
    const Foam::scalar value = dict.get<Foam::scalar>(key);
    if (value < 0 || (value == 0 && !zeroAllowed))
    {
        FatalIOErrorInFunction(dict)
            << key << " is " << value << "; expected a value "
            << (zeroAllowed ? "not below" : "above") << " zero"
            << Foam::exit(Foam::FatalIOError);
    }
    return value;
}

} // End anonymous namespace


void Foam::viscosityModels::Bingham::readCoeffs()
{
    const dictionary& coeffs =
        viscosityProperties_.optionalSubDict(typeName + "Coeffs");
    const scalar rho = readBounded(viscosityProperties_, "rho", false);

    regularisation_ = regularisationNames_.getOrDefault(
        "regularisation", coeffs, regularisation::biviscosity);
    tau0_.value() = readBounded(coeffs, "yieldStress", true) / rho;
    nuPlastic_.value() = readBounded(coeffs, "plasticViscosity", false) / rho;

    if (regularisation_ == regularisation::biviscosity)
    {
        nuMax_.value() =
            readBounded(coeffs, "viscosityRatio", false) * nuPlastic_.value();
    }
    else
    {
        m_.value() = readBounded(coeffs, "m", false);
    }
}


Foam::tmp<Foam::volScalarField> Foam::viscosityModels::Bingham::calcNu() const
{
    // Below 1e-8/s both forms are at their cap; smaller rates only cancel in
    // 1 - exp(-m gamma)
    const tmp<volScalarField> gamma(
        max(strainRate(), dimensionedScalar("rest", dimless / dimTime, 1e-8)));

    if (regularisation_ == regularisation::biviscosity)
    {
        return min(nuMax_, nuPlastic_ + tau0_ / gamma);
    }
    return nuPlastic_ + tau0_ * (scalar(1) - exp(-m_ * gamma())) / gamma();
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::viscosityModels::Bingham::Bingham(
    const word& name, const dictionary& viscosityProperties,
    const volVectorField& U, const surfaceScalarField& phi)
: viscosityModel(name, viscosityProperties, U, phi),
  regularisation_(regularisation::biviscosity),
  tau0_("tau0", dimViscosity / dimTime, Zero),
  nuPlastic_("nuPlastic", dimViscosity, Zero),
  nuMax_("nuMax", dimViscosity, Zero),
  m_("m", dimTime, Zero),
  nu_(IOobject(
          name, U_.time().timeName(), U_.db(), IOobject::NO_READ,
          IOobject::AUTO_WRITE),
      U_.mesh(), dimensionedScalar(dimViscosity, Zero))
{
    readCoeffs();
    nu_ = calcNu();
}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

bool Foam::viscosityModels::Bingham::read(const dictionary& viscosityProperties)
{
    viscosityModel::read(viscosityProperties);
    readCoeffs();
    return true;
}


// ************************************************************************* //
