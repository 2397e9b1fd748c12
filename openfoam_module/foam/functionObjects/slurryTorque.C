/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryTorque.H"
#include "gravityMeshObject.H"
#include "optionalDictionary.H"
#include "restingWallVelocityFvPatchVectorField.H"
#include "wallFriction.H"
#include "wallPolyPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Numbers of the patches of these names; all walls without the entry
static labelList
wallsOf(const polyBoundaryMesh& patches, const dictionary& dict)
{
    if (!dict.found("walls"))
    {
        return patches.findPatchIDs<wallPolyPatch>().sortedToc();
    }
    const wordRes names(dict.get<wordRes>("walls"));
    for (const wordRe& name : names)
    {
        if (patches.patchSet(List<wordRe>(1, name), false).empty())
        {
            FatalIOErrorInFunction(dict)
                << "walls has " << name
                << ", and no patch has such a name; expected some of "
                << patches.names() << exit(FatalIOError);
        }
    }
    return patches.patchSet(names, false).sortedToc();
}


//- Which patches rest: those of walls that the entry resting names, and all at
//  which the velocity is restingWallVelocity
static List<bool> restingOf(
    const volVectorField& U, const labelList& walls, const dictionary& dict)
{
    const polyBoundaryMesh& patches = U.mesh().boundaryMesh();
    List<bool> result(patches.size());
    forAll(result, patchi)
    {
        result[patchi] = isA<restingWallVelocityFvPatchVectorField>(
            U.boundaryField()[patchi]);
    }
    for (const wordRe& name :
         dict.lookupOrDefault<wordRes>("resting", wordRes()))
    {
        bool isWall = false;
        for (const label patchi : walls)
        {
            const bool named = name.match(patches[patchi].name());
            result[patchi] = result[patchi] || named;
            isWall = isWall || named;
        }
        if (!isWall)
        {
            FatalIOErrorInFunction(dict)
                << "resting has " << name
                << ", which is none of the walls; expected patches of walls"
                << exit(FatalIOError);
        }
    }
    return result;
}


//- If walls are at rest, those that are neither at rest nor among these walls
static labelList othersOf(
    const polyBoundaryMesh& patches, const labelList& walls,
    const List<bool>& resting)
{
    labelList result;
    if (resting.found(true))
    {
        for (const label patchi :
             patches.findPatchIDs<wallPolyPatch>().sortedToc())
        {
            if (!resting[patchi] && !walls.found(patchi))
            {
                result.append(patchi);
            }
        }
    }
    return result;
}


//- Angular speed of the mill about z, rad/s
static scalar millSpeed(const fvMesh& mesh, const dictionary& dict)
{
    const IOdictionary mill(
        optionalDictionary("millProperties", mesh.time(), false));
    scalar speed = 0;
    if (!dict.readIfPresent("speed", speed) &&
        !mill.readIfPresent("omega", speed))
    {
        FatalIOErrorInFunction(dict)
            << "neither the entry 'speed' nor omega of " << mill.objectPath()
            << " gives the mill's angular speed, rad/s" << exit(FatalIOError);
    }
    return speed;
}

//- What balls between walls at rest feel, if that is all that acts on the fluid
static const fluidOnBalls* ballsOf(const fvMesh& mesh, const bool resting)
{
    const auto* balls = mesh.findObject<fluidOnBalls>(fluidOnBalls::typeName);
    return resting && balls && !balls->flow().polydispersity ? balls : nullptr;
}


//- Component along z of the sum of moments
static scalar moment(const vectorField& places, const vectorField& forces)
{
    return sum((places ^ forces)().component(vector::Z));
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slurryTorque::slurryTorque(
    const slurryFields& fields, const dictionary& dict)
: fields_(fields),
  walls_(wallsOf(fields.mesh().boundaryMesh(), dict)),
  resting_(restingOf(fields.U(), walls_, dict)),
  others_(othersOf(fields.mesh().boundaryMesh(), walls_, resting_)),
  speed_(millSpeed(fields.mesh(), dict)),
  balls_(ballsOf(fields.mesh(), resting_.found(true)))
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::slurryTorque::names() const
{
    wordList result;
    for (const label patchi : walls_)
    {
        result.append(fields_.mesh().boundary()[patchi].name());
    }
    return result;
}


Foam::scalar Foam::slurryTorque::speedOf(const label patchi) const
{
    return resting_[patchi] ? 0 : speed_;
}


Foam::scalarField Foam::slurryTorque::ofWalls() const
{
    return of(walls_);
}


Foam::scalarField Foam::slurryTorque::of(const labelList& patches) const
{
    scalarField result(patches.size(), Zero);
    forAll(patches, i)
    {
        const fvPatch& patch = fields_.mesh().boundary()[patches[i]];
        const scalarField& p = fields_.p().boundaryField()[patches[i]];
        const vectorField force(
            wallFriction(fields_, patches[i], speedOf(patches[i])) -
            p * patch.Sf());
        result[i] = returnReduce(moment(patch.Cf(), force), sumOp<scalar>());
    }
    return result;
}


Foam::scalar Foam::slurryTorque::ofBalls() const
{
    const fvMesh& mesh = fields_.mesh();
    const ballForces feel(balls_->present());
    const vectorField force(
        feel.solidity * mesh.V() *
        (feel.pressure +
         feel.exchange * (fields_.U().primitiveField() - feel.velocity)));
    return -returnReduce(
        moment(mesh.C().primitiveField(), force), sumOp<scalar>());
}


Foam::scalarField Foam::slurryTorque::powers(const scalarField& torques) const
{
    scalarField result(speed_ * torques);
    forAll(result, i)
    {
        if (resting_[walls_[i]])
        {
            result[i] = 0;
        }
    }
    return result;
}


Foam::scalar
Foam::slurryTorque::power(const scalar all, const scalarField& torques) const
{
    return resting_.found(true)
               ? sum(powers(torques)) + speed_ * sum(of(others_))
               : speed_ * all;
}


Foam::scalar Foam::slurryTorque::momentum() const
{
    const fvMesh& mesh = fields_.mesh();
    const scalarField& density =
        mesh.lookupObject<volScalarField>("rho").primitiveField();
    const scalar result = moment(
        mesh.C().primitiveField(),
        fields_.voidage() * mesh.V() * density * fields_.U().primitiveField());
    return returnReduce(result, sumOp<scalar>());
}


Foam::scalar Foam::slurryTorque::drain() const
{
    const fvMesh& mesh = fields_.mesh();
    const volScalarField& rho = mesh.lookupObject<volScalarField>("rho");
    const auto& phi = mesh.lookupObject<surfaceScalarField>("phi");
    const vector g(meshObjects::gravity::New(mesh.time()).value());

    scalar result = -moment(
        mesh.C().primitiveField(),
        fields_.voidage() * mesh.V() * rho.primitiveField() * g);
    forAll(mesh.boundary(), patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        if (!patch.coupled())
        {
            result += moment(
                patch.Cf(), phi.boundaryField()[patchi] *
                                rho.boundaryField()[patchi] *
                                fields_.U().boundaryField()[patchi]);
        }
    }
    return returnReduce(result, sumOp<scalar>());
}


// ************************************************************************* //
