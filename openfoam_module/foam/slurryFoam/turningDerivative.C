/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "turningDerivative.H"
#include "coupledPatches.H"
#include "flowState.H"
#include "meshRotation.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Rotation by an angle (rad) about z, right-handed
static tensor turnAboutZ(const scalar angle)
{
    const scalar c = std::cos(angle);
    const scalar s = std::sin(angle);
    return tensor(c, -s, 0, s, c, 0, 0, 0, 1);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::turningDerivative::turningDerivative(
    const volVectorField& U, const vector& gravity)
: U_(U),
  angle_(0)
{
    const bool upright =
        mag(gravity.x()) + mag(gravity.y()) <= SMALL * mag(gravity.z());
    if (upright && meshTurns(U.time()))
    {
        requireAxisThroughOrigin(U.time());
        requireState({"stepAcceleration"}, U.mesh());
        U.oldTime(); // before turn() changes U
        last_.reset(new volVectorField(
            IOobject(
                "stepAcceleration", U.time().timeName(), U.mesh(),
                IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE),
            U.mesh(), dimensionedVector(dimAcceleration, Zero)));
        evaluateCoupled(last_.ref());
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::turningDerivative::turn(volVectorField& U, volVectorField& forces)
{
    if (last_.valid())
    {
        const pointField& before = U_.mesh().oldPoints();
        const pointField& now = U_.mesh().points();
        const vector cross(gSum((before ^ now)()));
        const tensor dot(gSum((before * now)()));
        angle_ = std::atan2(cross.z(), dot.xx() + dot.yy());
        const tensor turn = turnAboutZ(angle_);
        U.primitiveFieldRef() = turn & U.primitiveField();
        U.correctBoundaryConditions();
        forces.primitiveFieldRef() = turn & forces.primitiveField();
        forces.correctBoundaryConditions();
    }
}


Foam::tmp<Foam::volVectorField::Internal> Foam::turningDerivative::lack() const
{
    if (!last_.valid())
    {
        return nullptr;
    }
    const tensor turn = turnAboutZ(angle_) - turnAboutZ(1.5 * angle_);
    return tmp<volVectorField::Internal>::New(
        "turningLack", turn & last_->internalField());
}


Foam::vector Foam::turningDerivative::centripetal(
    const point& x, const vector& u, const scalar size)
{
    const vector arm(x.x(), x.y(), 0);
    const scalar spin = (arm ^ u).z() / max(magSqr(arm), sqr(size));
    return -sqr(spin) * arm;
}


Foam::tmp<Foam::volVectorField::Internal>
Foam::turningDerivative::centripetal() const
{
    if (!last_.valid())
    {
        return nullptr;
    }
    auto tresult = tmp<volVectorField::Internal>::New(
        IOobject("centripetal", U_.time().timeName(), U_.mesh()), U_.mesh(),
        dimensionedVector(dimAcceleration, Zero));
    const vectorField& centres = U_.mesh().cellCentres();
    forAll(centres, celli)
    {
        const scalar size = cbrt(U_.mesh().V()[celli]);
        tresult.ref()[celli] = centripetal(centres[celli], U_[celli], size);
    }
    return tresult;
}


void Foam::turningDerivative::keep()
{
    if (last_.valid())
    {
        last_.ref() = (U_ - U_.oldTime()) / U_.time().deltaT();
    }
}


// ************************************************************************* //
