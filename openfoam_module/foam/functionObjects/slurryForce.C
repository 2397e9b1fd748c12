/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryForce.H"
#include "gravityMeshObject.H"
#include "wallFriction.H"
#include "wallPolyPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- What the balls feel, if they and the boundary are all that acts on the fluid
static const fluidOnBalls* ballsOf(const fvMesh& mesh)
{
    const auto* balls = mesh.findObject<fluidOnBalls>(fluidOnBalls::typeName);
    return balls && !balls->flow().othersAct ? balls : nullptr;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::vector Foam::slurryForce::momentum() const
{
    const fvMesh& mesh = fields_.mesh();
    const scalarField& density =
        mesh.lookupObject<volScalarField>("rho").primitiveField();
    return gSum(
        (fields_.voidage() * mesh.V() * density *
         fields_.U().primitiveField())());
}


Foam::vector Foam::slurryForce::outside() const
{
    const fvMesh& mesh = fields_.mesh();
    const volScalarField& rho = mesh.lookupObject<volScalarField>("rho");
    const auto& phi = mesh.lookupObject<surfaceScalarField>("phi");
    const vector g(meshObjects::gravity::New(mesh.time()).value());

    vector result =
        g * sum((fields_.voidage() * mesh.V() * rho.primitiveField())());
    forAll(mesh.boundary(), patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        if (patch.coupled())
        {
            continue;
        }
        result -= sum(
            (fields_.p().boundaryField()[patchi] * patch.Sf() +
             phi.boundaryField()[patchi] * rho.boundaryField()[patchi] *
                 fields_.U().boundaryField()[patchi])());
        if (isA<wallPolyPatch>(patch.patch()))
        {
            result +=
                sum(wallFriction(fields_, patchi, torque_.speedOf(patchi))());
        }
    }
    return returnReduce(result, sumOp<vector>());
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slurryForce::slurryForce(
    const slurryFields& fields, const slurryTorque& torque)
: fields_(fields),
  torque_(torque),
  balls_(ballsOf(fields.mesh())),
  momentum_(known() ? momentum() : vector::zero),
  balance_(Zero)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slurryForce::update()
{
    if (known())
    {
        const vector present(momentum());
        balance_ = outside() -
                   (present - momentum_) / fields_.mesh().time().deltaTValue();
        momentum_ = present;
    }
}


Foam::vector Foam::slurryForce::felt() const
{
    const ballForces feel(balls_->present());
    return gSum(
        (feel.solidity * fields_.mesh().V() *
         (feel.pressure +
          feel.exchange * (fields_.U().primitiveField() - feel.velocity)))());
}


// ************************************************************************* //
