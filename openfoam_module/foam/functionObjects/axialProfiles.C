/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "axialProfiles.H"
#include "addToRunTimeSelectionTable.H"
#include "clock.H"
#include "optionalDictionary.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(axialProfiles, 0);
addToRunTimeSelectionTable(functionObject, axialProfiles, dictionary);
} // End namespace functionObjects
} // End namespace Foam

const Foam::FixedList<
    Foam::word, Foam::functionObjects::axialProfiles::nQuantities>
    Foam::functionObjects::axialProfiles::names_{
        "holdUp", "height", "x", "p_rgh"};


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::functionObjects::axialProfiles::place(const dictionary& dict)
{
    const IOdictionary mill(
        optionalDictionary("millProperties", mesh_.time(), false));
    FixedList<scalar, 2> ends(Zero);
    if (!dict.readIfPresent("ends", ends) &&
        !mill.readIfPresent("length", ends[1]))
    {
        FatalIOErrorInFunction(dict)
            << "neither the entry 'ends' nor length of " << mill.objectPath()
            << " says where the mill ends, m" << exit(FatalIOError);
    }
    if (slices_ < 1 || !(ends[1] > ends[0]))
    {
        FatalIOErrorInFunction(dict)
            << "slices is " << slices_ << " between z = " << ends[0] << " and "
            << ends[1] << " m; expected one or more, and rising ends"
            << exit(FatalIOError);
    }
    begin_ = ends[0];
    thickness_ = (ends[1] - ends[0]) / slices_;
}


void Foam::functionObjects::axialProfiles::open()
{
    forAll(files_, i)
    {
#if OPENFOAM < 2212
        files_[i] = createFile(names_[i]);
#else
        files_[i] = newFileAtStartTime(names_[i]);
#endif
        if (files_[i].valid())
        {
            writeHeaderValue(files_[i](), "Begun", label(clock::getTime()));
            writeCommented(files_[i](), "Time_s, then slices at z_m");
            for (label slice = 0; slice < slices_; ++slice)
            {
                files_[i]() << tab << begin_ + (slice + 0.5) * thickness_;
            }
            files_[i]() << endl;
        }
    }
}


void Foam::functionObjects::axialProfiles::requireCells(
    const dictionary& dict) const
{
    const scalarField z(mesh_.points().component(vector::Z));
    const scalar low = gMin(z);
    const scalar high = gMax(z);
    const scalar end = begin_ + slices_ * thickness_;
    if (low > begin_ + thickness_ || high < end - thickness_)
    {
        FatalIOErrorInFunction(dict)
            << "slices from " << begin_ << " to " << end
            << " m along z, but the mesh reaches from " << low << " to " << high
            << " m, so that some have no cells; expected ends within the mesh"
            << exit(FatalIOError);
    }
}


Foam::FixedList<
    Foam::scalarField, Foam::functionObjects::axialProfiles::nQuantities>
Foam::functionObjects::axialProfiles::sums() const
{
    FixedList<scalarField, nQuantities> result(scalarField(slices_, Zero));
    const scalarField volumes(fields_.volumes());
    const scalarField& head = fields_.p_rgh().primitiveField();
    const labelListList& points = mesh_.cellPoints();

    forAll(volumes, celli)
    {
        scalar low = GREAT;
        scalar high = -GREAT;
        for (const label pointi : points[celli])
        {
            const scalar z = (mesh_.points()[pointi].z() - begin_) / thickness_;
            low = min(low, z);
            high = max(high, z);
        }
        const label last = min(label(std::ceil(high)), slices_);
        for (label slice = max(label(std::floor(low)), 0); slice < last;
             ++slice)
        {
            const scalar part = min(high, slice + 1) - max(low, slice);
            const scalar slurry = volumes[celli] * part / (high - low);
            result[holdUp][slice] += slurry;
            result[height][slice] += slurry * mesh_.C()[celli].y();
            result[x][slice] += slurry * mesh_.C()[celli].x();
            result[p_rgh][slice] += slurry * head[celli];
        }
    }
    for (scalarField& sum : result)
    {
        Pstream::listCombineGather(sum, plusEqOp<scalar>());
    }
    return result;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::axialProfiles::axialProfiles(
    const word& name, const Time& runTime, const dictionary& dict)
: fvMeshFunctionObject(name, runTime, dict),
  writeFile(mesh_, name),
  fields_(mesh_, dict),
  slices_(dict.get<label>("slices"))
{
    slurryFields::refuseOthers(dict, {"slices", "ends"});
    writeFile::read(dict);
    place(dict);
    open();
    const scalar all = gSum(fields_.volumes()());
    const scalar sliced = returnReduce(sum(sums()[holdUp]), maxOp<scalar>());
    requireCells(dict);
    Info << "axialProfiles: slices from " << begin_ << " to "
         << begin_ + slices_ * thickness_ << " m; " << all - sliced
         << " m3 of slurry lie beyond them now" << endl;
    strict_.relax();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::axialProfiles::execute()
{
    return true;
}


bool Foam::functionObjects::axialProfiles::write()
{
    const FixedList<scalarField, nQuantities> found(sums());
    forAll(files_, i)
    {
        if (files_[i].valid())
        {
            writeCurrentTime(files_[i]());
            forAll(found[holdUp], slice)
            {
                const scalar slurry = found[holdUp][slice];
                const scalar mean =
                    slurry > VSMALL ? found[i][slice] / slurry : 0;
                files_[i]() << tab << (i == holdUp ? slurry : mean);
            }
            files_[i]() << endl;
        }
    }
    return true;
}


// ************************************************************************* //
