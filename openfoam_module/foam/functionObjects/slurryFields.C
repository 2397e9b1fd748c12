/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryFields.H"
#include "knownEntries.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

template <class FieldType>
const FieldType& Foam::slurryFields::find(const word& name) const
{
    if (!mesh_.foundObject<FieldType>(name))
    {
        FatalIOErrorInFunction(dict_)
            << dict_.dictName() << ": the flow has no " << FieldType::typeName
            << " '" << name << "', it has "
            << flatOutput(mesh_.sortedNames<FieldType>())
            << "; give the right name by the entries phase, U, p or p_rgh"
            << exit(FatalIOError);
    }
    return mesh_.lookupObject<FieldType>(name);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slurryFields::slurryFields(const fvMesh& mesh, const dictionary& dict)
: mesh_(mesh),
  dict_(dict),
  phase_(dict.lookupOrDefault<word>("phase", "slurry")),
  U_(dict.lookupOrDefault<word>("U", "U")),
  p_(dict.lookupOrDefault<word>("p", "p")),
  p_rgh_(dict.lookupOrDefault<word>("p_rgh", "p_rgh"))
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::slurryFields::entries()
{
    return {"phase", "U", "p", "p_rgh"};
}


void Foam::slurryFields::refuseOthers(
    const dictionary& dict, const wordList& own)
{
    // Without those that would leave out time-steps: integrals need them all
    wordList known(
        {"type", "libs", "functionObjectLibs", "region", "enabled", "log",
         "writeControl", "writeInterval", "writePrecision", "writeToFile",
         "useUserTime", "errors"});
    known.append(entries());
    known.append(own);
    requireKnownEntries(dict, known);
}


const Foam::volScalarField& Foam::slurryFields::alpha() const
{
    return find<volScalarField>(IOobject::groupName("alpha", phase_));
}


const Foam::volVectorField& Foam::slurryFields::U() const
{
    return find<volVectorField>(U_);
}


const Foam::volScalarField& Foam::slurryFields::p() const
{
    return find<volScalarField>(p_);
}


const Foam::volScalarField& Foam::slurryFields::p_rgh() const
{
    return find<volScalarField>(p_rgh_);
}


const Foam::surfaceScalarField& Foam::slurryFields::flux() const
{
    // interFoam's, or slurryFoam's
    const word inter(IOobject::groupName("alphaPhi0", phase_));
    return find<surfaceScalarField>(
        mesh_.foundObject<surfaceScalarField>(inter)
            ? inter
            : IOobject::groupName("alphaPhi", phase_));
}


void Foam::slurryFields::requireWholeFlux() const
{
    const dictionary* solvers = mesh_.solutionDict().findDict("solvers");
    const dictionary* controls =
        solvers ? solvers->findDict(alpha().name()) : nullptr;
    const label cycles =
        controls ? controls->lookupOrDefault<label>("nAlphaSubCycles", 1) : 1;
    if (cycles > 1)
    {
        FatalIOErrorInFunction(*controls)
            << "nAlphaSubCycles is " << cycles << "; a balance of "
            << alpha().name() << " expects 1: of sub-cycles only the"
            << " last one's flux is kept" << exit(FatalIOError);
    }
}


bool Foam::slurryFields::displaced() const
{
    return mesh_.foundObject<volScalarField>("flowVoidage");
}


Foam::tmp<Foam::scalarField> Foam::slurryFields::voidage() const
{
    if (displaced())
    {
        return tmp<scalarField>::New(
            mesh_.lookupObject<volScalarField>("flowVoidage").primitiveField());
    }
    return tmp<scalarField>::New(mesh_.nCells(), 1.0);
}


Foam::tmp<Foam::scalarField> Foam::slurryFields::volumes() const
{
    return voidage() * alpha().primitiveField() * mesh_.V();
}


// ************************************************************************* //
