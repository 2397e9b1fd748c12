/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshPart.H"
#include "faceIOList.H"
#include "labelIOList.H"
#include "ListOps.H"
#include "pointIOField.H"
#include "polyBoundaryMeshEntries.H"
#include "polyMesh.H"
#include "processorCyclicPolyPatch.H"
#include "processorPolyPatch.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::IOobject
Foam::meshPart::listIO(const word& name, const word& instance) const
{
    return IOobject(
        name, instance, polyMesh::meshSubDir, *time_, IOobject::MUST_READ,
        IOobject::NO_WRITE, false);
}


bool Foam::meshPart::has(const word& name, const word& instance) const
{
    return isFile(listIO(name, instance).objectPath());
}


void Foam::meshPart::readPatches()
{
    const polyBoundaryMeshEntries entries(
        listIO("boundary", time_->constant()));

    patches_.resize(entries.size());
    forAll(entries, i)
    {
        const dictionary& dict = entries[i].dict();
        const word type(dict.get<word>("type"));

        patch& p = patches_[i];
        p.cut = true;
        p.start = dict.get<label>("startFace");
        p.size = dict.get<label>("nFaces");
        if (type == processorCyclicPolyPatch::typeName)
        {
            p.name = dict.get<word>("referPatch");
        }
        else if (type != processorPolyPatch::typeName)
        {
            p.name = entries[i].keyword();
            p.cut = false;
        }
    }
}


void Foam::meshPart::readLabels()
{
    const word constant(time_->constant());

    pointLabels_ = labelIOList(listIO("pointProcAddressing", constant));
    faceLabels_ = labelIOList(listIO("faceProcAddressing", constant));
    cellLabels_ = labelIOList(listIO("cellProcAddressing", constant));
}


void Foam::meshPart::numberLabels()
{
    const word constant(time_->constant());

    pointLabels_ = identity(pointIOField(listIO("points", constant)).size());
    faceLabels_ = identity(faces_.size(), 1);
    cellLabels_ = identity(nCells());
}


void Foam::meshPart::check() const
{
    checkSize("owner", owner_, faces_.size());
    // There are fewer cells than faces
    checkRange("owner", owner_, faces_.size());
    checkRange("neighbour", neighbour_, faces_.size());
    checkCells();
    checkSize("faceProcAddressing", faceLabels_, faces_.size());
    checkSize("cellProcAddressing", cellLabels_, nCells());
    checkRange("pointProcAddressing", pointLabels_, labelMax);
    checkRange("cellProcAddressing", cellLabels_, labelMax);
    if (faceLabels_.found(0))
    {
        FatalErrorInFunction
            << listIO("faceProcAddressing", time_->constant()).objectPath()
            << " holds a 0; expected labels from 1, with their signs"
            << exit(FatalError);
    }
    for (const face& f : faces_)
    {
        checkRange("faces", f, pointLabels_.size());
    }
    for (const patch& p : patches_)
    {
        const labelList ends({p.start, p.start + p.size});
        checkRange("boundary", ends, faces_.size() + 1);
    }
}


void Foam::meshPart::checkCells() const
{
    const label fewest = 4;
    labelList count(nCells(), 0);
    for (const labelList* cells : {&owner_, &neighbour_})
    {
        for (const label celli : *cells)
        {
            ++count[celli];
        }
    }
    forAll(count, celli)
    {
        if (count[celli] < fewest)
        {
            FatalErrorInFunction
                << "cell " << celli << " has " << count[celli] << " faces in "
                << listIO("owner", time_->constant()).objectPath() << " and "
                << "neighbour, whose largest label is " << nCells() - 1
                << "; expected " << fewest << " faces or more"
                << exit(FatalError);
        }
    }
}


void Foam::meshPart::checkSize(
    const word& name, const labelUList& list, const label expected) const
{
    if (list.size() != expected)
    {
        FatalErrorInFunction << listIO(name, time_->constant()).objectPath()
                             << " has " << list.size() << " entries; expected "
                             << expected << " for the mesh in the same folder"
                             << exit(FatalError);
    }
}


void Foam::meshPart::checkRange(
    const word& name, const labelUList& list, const label end) const
{
    for (const label i : list)
    {
        if (i < 0 || i >= end)
        {
            FatalErrorInFunction << listIO(name, time_->constant()).objectPath()
                                 << " holds the label " << i
                                 << "; expected 0 to " << end - 1
                                 << exit(FatalError);
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshPart::meshPart(autoPtr<Time> time, const bool decomposed)
: time_(std::move(time)),
  faces_(faceCompactIOList(listIO("faces", time_->constant()))),
  owner_(labelIOList(listIO("owner", time_->constant()))),
  neighbour_(labelIOList(listIO("neighbour", time_->constant())))
{
    readPatches();
    if (decomposed)
    {
        readLabels();
    }
    else
    {
        numberLabels();
    }
    check();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::meshPart::nCells() const
{
    label last = -1;
    for (const labelList* cells : {&owner_, &neighbour_})
    {
        for (const label celli : *cells)
        {
            last = max(last, celli);
        }
    }
    return last + 1;
}


bool Foam::meshPart::hasPoints(const word& instance) const
{
    return has("points", instance);
}


Foam::pointField Foam::meshPart::points(const word& instance) const
{
    pointIOField found(listIO("points", instance));
    if (found.size() != pointLabels_.size())
    {
        FatalErrorInFunction
            << found.objectPath() << " has " << found.size()
            << " points; expected the " << pointLabels_.size()
            << " of the mesh in " << time_->constant()
            << ": its points may move, but their number must stay"
            << exit(FatalError);
    }
    return pointField(std::move(found));
}


void Foam::meshPart::checkTopology(const word& instance) const
{
    const bool same =
        (!has("faces", instance) ||
         faceCompactIOList(listIO("faces", instance)) == faces_) &&
        (!has("owner", instance) ||
         labelIOList(listIO("owner", instance)) == owner_) &&
        (!has("neighbour", instance) ||
         labelIOList(listIO("neighbour", instance)) == neighbour_);
    if (!same)
    {
        FatalErrorInFunction
            << "the mesh's topology changes at time " << instance << ": faces,"
            << " owner or neighbour of "
            << listIO("faces", instance).objectPath().path()
            << " differ from those of " << time_->constant()
            << "; expected a mesh of which only the points move"
            << exit(FatalError);
    }
}


// ************************************************************************* //
