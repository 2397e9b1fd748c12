/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "poreSuction.H"
#include "knownEntries.H"
#include "linear.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::poreSuction::poreSuction(
    const dictionary& dict, const dimensionedScalar& surfaceTension)
: pull_("pull", surfaceTension)
{
    requireKnownEntries(dict, {"contactAngle"});
    const scalar angle = dict.get<scalar>("contactAngle");
    if (!(angle >= 0 && angle <= 180))
    {
        FatalIOErrorInFunction(dict)
            << "contactAngle is " << angle << "; expected degrees from 0 to 180"
            << exit(FatalIOError);
    }
    if (!(surfaceTension.value() > 0))
    {
        FatalIOErrorInFunction(dict)
            << "sigma of transportProperties is " << surfaceTension.value()
            << " N/m; expected a surface tension above 0 with poreSuction"
            << exit(FatalIOError);
    }
    pull_ *= Foam::cos(degToRad(angle));
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::surfaceScalarField>
Foam::poreSuction::atFaces(const movingBed& bed) const
{
    const dimensionedScalar none("none", dimLength, VSMALL);
    return linearInterpolate(
        6 * pull_ * bed.solidity() /
        (bed.voidage() * max(bed.diameter(), none)));
}


// ************************************************************************* //
