/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "toldForces.H"
#include "fvMesh.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- A part that is written with the times
static IOobject
partIO(const word& name, const fvMesh& mesh, const fileName& folder = "")
{
    return IOobject(
        name, mesh.time().timeName(), folder, mesh, IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::toldForces::toldForces(const fvMesh& mesh)
: pressure_(
      partIO("toldPressure", mesh), mesh,
      dimensionedVector(dimForce / dimVolume, Zero)),
  exchange_(
      partIO("toldExchange", mesh), mesh,
      dimensionedScalar(dimDensity / dimTime, Zero)),
  totals_(partIO("toldForces", mesh, "uniform")),
  untold_(totals_.found("torque")),
  force_(totals_.lookupOrDefault<vector>("force", Zero)),
  torque_(totals_.lookupOrDefault<scalar>("torque", 0))
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::toldForces::takeUp(ballForces& feel)
{
    if (!untold_)
    {
        return false;
    }
    feel.pressure = pressure_.primitiveField();
    feel.exchange = exchange_.primitiveField();
    untold_ = false;
    return true;
}


void Foam::toldForces::keep(
    const ballForces& feel, const vector& force, const scalar torque)
{
    pressure_.primitiveFieldRef() = feel.pressure;
    exchange_.primitiveFieldRef() = feel.exchange;
    force_ = force;
    torque_ = torque;
    totals_.set("force", force_);
    totals_.set("torque", torque_);
}


// ************************************************************************* //
