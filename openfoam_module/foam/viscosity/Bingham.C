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


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::viscosityModels::Bingham::readCoeffs()
{
    const binghamEntries entries(viscosityProperties_);
    regularisation_ = entries.form;
    tau0_.value() = entries.yieldStress / entries.density;
    nuPlastic_.value() = entries.plasticViscosity / entries.density;
    nuMax_.value() = entries.viscosityRatio * nuPlastic_.value();
    m_.value() = entries.m;
}


Foam::tmp<Foam::volScalarField> Foam::viscosityModels::Bingham::calcNu() const
{
    // Below 1e-8/s both forms are at their cap; smaller rates only cancel in
    // 1 - exp(-m gamma)
    const tmp<volScalarField> gamma(
        max(strainRate(), dimensionedScalar("rest", dimless / dimTime, 1e-8)));

    if (regularisation_ == binghamEntries::regularisation::biviscosity)
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
  regularisation_(binghamEntries::regularisation::biviscosity),
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
