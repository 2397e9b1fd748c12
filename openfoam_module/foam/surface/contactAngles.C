/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "contactAngles.H"
#include "mathematicalConstants.H"
#include "StringStream.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Angle of a patch with a constant one, rad
scalar constantAngle(const fvPatchScalarField& alpha)
{
    OStringStream text;
    alpha.write(text);
    IStringStream stream(text.str());
    const scalar angle = dictionary(stream).get<scalar>("theta0");
    if (!(angle > 0 && angle < 180))
    {
        FatalErrorInFunction
            << "theta0 of " << alpha.internalField().name() << " at the patch "
            << alpha.patch().name() << " is " << angle
            << "; expected a contact angle in degrees, above 0 and below 180"
            << exit(FatalError);
    }
    return degToRad(angle);
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

std::vector<std::optional<Foam::scalar>>
Foam::contactAngles(const volScalarField& alpha)
{
    std::vector<std::optional<scalar>> result;
    for (const fvPatchScalarField& patch : alpha.boundaryField())
    {
        const polyPatch& shape = patch.patch().patch();
        std::optional<scalar>& angle = result.emplace_back();
        if (isA<symmetryPolyPatch>(shape) || isA<symmetryPlanePolyPatch>(shape))
        {
            angle = constant::mathematical::piByTwo;
        }
        else if (patch.type() == "constantAlphaContactAngle")
        {
            angle = constantAngle(patch);
        }
        else if (patch.type().ends_with("AlphaContactAngle"))
        {
            FatalErrorInFunction
                << alpha.name() << " at the patch " << patch.patch().name()
                << " has the type " << patch.type()
                << ", which slurryFoam cannot obey; expected"
                << " constantAlphaContactAngle" << exit(FatalError);
        }
    }
    return result;
}


// ************************************************************************* //
