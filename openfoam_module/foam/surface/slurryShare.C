/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryShare.H"
#include "coupledPatches.H"
#include "fixedValueFvPatchFields.H"
#include "mixedFvPatchFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- How far shares may lie beyond 0 and 1: ten times as far as those of any
//  recorded flow, 1e-4
constexpr scalar beyond_ = 1e-3;


bool isShare(const scalar value)
{
    return value >= -beyond_ && value <= 1 + beyond_;
}


//- What a patch gives to a fluid that enters; none where it takes the cells'
const scalarField* givenBy(const fvPatchScalarField& share)
{
    if (isA<mixedFvPatchScalarField>(share))
    {
        return &refCast<const mixedFvPatchScalarField>(share).refValue();
    }
    return isA<fixedValueFvPatchScalarField>(share) ? &share : nullptr;
}


void refuse(const fvPatchScalarField& share, const label facei)
{
    FatalErrorInFunction << share.internalField().objectPath() << ": "
                         << share.internalField().name() << " at the patch "
                         << share.patch().name() << " (" << share.type()
                         << ") is " << (*givenBy(share))[facei] << " at "
                         << share.patch().Cf()[facei] << " m; expected 0 to 1"
                         << exit(FatalError);
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::volScalarField& Foam::checkedShare(volScalarField& alpha)
{
    forAll(alpha, celli)
    {
        if (!isShare(alpha[celli]))
        {
            FatalErrorInFunction << alpha.objectPath() << ": " << alpha.name()
                                 << " is " << alpha[celli] << " in cell "
                                 << celli << " at " << alpha.mesh().C()[celli]
                                 << " m; expected 0 to 1" << exit(FatalError);
        }
    }
    for (const fvPatchScalarField& patch : alpha.boundaryField())
    {
        if (const scalarField* given = givenBy(patch))
        {
            forAll(*given, i)
            {
                if (!isShare((*given)[i]))
                {
                    refuse(patch, i);
                }
            }
        }
    }
    return evaluateCoupled(alpha);
}


void Foam::checkInflow(const fvPatchScalarField& share, const scalarField& flow)
{
    if (const scalarField* given = givenBy(share))
    {
        forAll(*given, i)
        {
            if (flow[i] < 0 && !isShare((*given)[i]))
            {
                refuse(share, i);
            }
        }
    }
}


// ************************************************************************* //
