/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "closedMill.H"
#include "fixedValueFvPatchFields.H"
#include "superficialInletVelocityFvPatchVectorField.H"
#include "wallFvPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Largest share of the fluid that may have come in without room
constexpr scalar largest_ = 1e-3;


//- Whether the velocity at a patch does not depend on time or the flow
bool isFixed(const fvPatchVectorField& U)
{
    if (isA<superficialInletVelocityFvPatchVectorField>(U))
    {
        return refCast<const superficialInletVelocityFvPatchVectorField>(U)
            .constantRate();
    }
    return U.type() == fixedValueFvPatchVectorField::typeName;
}


//- Whether fluid may leave through a patch whose velocity is not fixed: it lets
//  pass what the flow brings, or its rate is not known at the start
bool mayLetOut(const fvPatchVectorField& U)
{
    return !U.coupled() && !isA<wallFvPatch>(U.patch()) &&
           !polyPatch::constraintType(U.patch().type());
}


void refuseFeed(const volVectorField& U, const volScalarField& voidage)
{
    scalar out = 0;
    scalar scale = 0;
    bool open = false;
    DynamicList<word> names;
    for (const fvPatchVectorField& patch : U.boundaryField())
    {
        if (!isFixed(patch))
        {
            open = open || mayLetOut(patch);
            continue;
        }
        tmp<fvPatchVectorField> now(patch.clone());
        now.ref().updateCoeffs();
        const scalarField& share =
            voidage.boundaryField()[patch.patch().index()];
        const scalar through = gSum((share * (now() & patch.patch().Sf()))());
        scale += gSum((share * mag(now()) * patch.patch().magSf())());
        out += through;
        if (through < 0)
        {
            names.append(patch.patch().name());
        }
    }
    if (!returnReduce(open, orOp<bool>()) && out < -1e-6 * scale)
    {
        FatalErrorInFunction
            << U.objectPath() << ": through the patches " << flatOutput(names)
            << " " << -out
            << " m3/s more fluid comes in than leaves, and no patch"
            << " gives a pressure, through which it could leave; expected"
            << " such an outlet, as one with prghPressure for p_rgh, or no"
            << " feed" << exit(FatalError);
    }
}


scalar volumeOf(const fvMesh& mesh)
{
    return gSum(mesh.V());
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::closedMill::closedMill(
    const volScalarField& p_rgh, const volVectorField& U,
    const volScalarField& voidage, const scalar surplus)
: mesh_(U.mesh()),
  closed_(p_rgh.needReference()),
  surplus_(surplus),
  volume_(volumeOf(mesh_))
{
    if (closed_)
    {
        refuseFeed(U, voidage);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::closedMill::add(
    const surfaceScalarField& phi, const volScalarField& voidage)
{
    if (!closed_)
    {
        return;
    }
    scalar out = 0;
    for (const fvsPatchScalarField& patch : phi.boundaryField())
    {
        out += patch.coupled() ? 0 : sum(patch);
    }
    reduce(out, sumOp<scalar>());
    const scalar volume = volumeOf(mesh_);
    surplus_ += volume_ - volume - out * mesh_.time().deltaTValue();
    volume_ = volume;

    const scalar fluid = gSum((mesh_.V() * voidage.primitiveField())());
    if (mag(surplus_) > largest_ * fluid)
    {
        FatalErrorInFunction
            << "time " << mesh_.time().timeName() << ": " << surplus_
            << " m3 of fluid (below 0: left) have come in through patches or"
            << " were displaced by walls, " << 100 * surplus_ / fluid
            << " % of the " << fluid << " m3 in the mill, and no patch gives a"
            << " pressure, which would balance them; expected such a patch, as"
            << " one with prghPressure for p_rgh, or neither feed nor walls"
            << " that change the mill's volume" << exit(FatalError);
    }
}


// ************************************************************************* //
