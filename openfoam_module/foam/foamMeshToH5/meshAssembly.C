/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshAssembly.H"
#include "averagingMesh.H"
#include "DynamicList.H"
#include "ListOps.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::meshAssembly::allocate()
{
    label nFaces = 0;
    for (const meshPart& part : parts_)
    {
        for (const label pointi : part.pointLabels())
        {
            nPoints_ = max(nPoints_, pointi + 1);
        }
        for (const label address : part.faceLabels())
        {
            nFaces = max(nFaces, mag(address));
        }
    }
    faces_.resize(nFaces);
    owner_.resize(nFaces, -1);
    neighbour_.resize(nFaces, -1);
    patchOf_.resize(nFaces, -1);

    for (const meshPart::patch& p : parts_.first().patches())
    {
        if (!p.cut)
        {
            patchNames_.append(p.name);
        }
    }
}


void Foam::meshAssembly::addFaces(const meshPart& part)
{
    forAll(part.faces(), i)
    {
        const label address = part.faceLabels()[i];
        const bool turned = address < 0;
        const label facei = mag(address) - 1;

        labelList& inner = turned ? neighbour_ : owner_;
        labelList& outer = turned ? owner_ : neighbour_;
        inner[facei] = part.cellLabels()[part.owner()[i]];
        if (i < part.neighbour().size())
        {
            outer[facei] = part.cellLabels()[part.neighbour()[i]];
        }
        if (!turned)
        {
            faces_[facei] = face(labelList(
                UIndirectList<label>(part.pointLabels(), part.faces()[i])));
        }
    }
}


void Foam::meshAssembly::addPatches(const meshPart& part)
{
    for (const meshPart::patch& p : part.patches())
    {
        const label patchi = patchNames_.find(p.name);
        for (label i = p.start; i < p.start + p.size; ++i)
        {
            patchOf_[mag(part.faceLabels()[i]) - 1] = patchi;
        }
    }
}


void Foam::meshAssembly::checkFaces() const
{
    forAll(faces_, facei)
    {
        const bool internal = neighbour_[facei] >= 0 && patchOf_[facei] < 0;
        const bool boundary = neighbour_[facei] < 0 && patchOf_[facei] >= 0;
        if (owner_[facei] < 0 || faces_[facei].empty() ||
            !(internal || boundary))
        {
            FatalErrorInFunction
                << "face " << facei << " of the whole mesh lacks a cell or a"
                << " patch in the " << parts_.size() << " parts from "
                << parts_.first().time().path() << " on; expected all parts of"
                << " one decomposition" << exit(FatalError);
        }
    }
}


Foam::label Foam::meshAssembly::nInternal() const
{
    label n = 0;
    while (n < neighbour_.size() && neighbour_[n] >= 0)
    {
        ++n;
    }
    return n;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshAssembly::meshAssembly(PtrList<meshPart>&& parts)
: parts_(std::move(parts)),
  nPoints_(0)
{
    allocate();
    for (const meshPart& part : parts_)
    {
        addFaces(part);
        addPatches(part);
    }
    checkFaces();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

millfoam::averaging::MeshTopology Foam::meshAssembly::topology() const
{
    // The last cell may own no face, and faces of the boundary have neighbour -1
    const label nCells =
        owner_.empty() ? 0 : max(max(owner_), max(neighbour_)) + 1;
    millfoam::averaging::MeshTopology result = averagingTopology(
        nPoints_, nCells, faces_, owner_,
        SubList<label>(neighbour_, nInternal()));

    int first = int(nInternal());
    forAll(patchNames_, patchi)
    {
        const int size = int(
            std::count(patchOf_.begin() + nInternal(), patchOf_.end(), patchi));
        result.patches.push_back({patchNames_[patchi], first, size});
        first += size;
    }
    return result;
}


Foam::instantList Foam::meshAssembly::times() const
{
    DynamicList<instant> result;
    result.append(instant(0));
    for (const instant& time : parts_.first().time().times())
    {
        const bool constant = time.name() == parts_.first().time().constant();
        if (constant || !parts_.first().hasPoints(time.name()))
        {
            continue;
        }
        if (time.value() == 0)
        {
            result.first() = time;
        }
        else
        {
            result.append(time);
        }
    }
    return instantList(std::move(result));
}


void Foam::meshAssembly::checkTopology(const instant& time) const
{
    for (const meshPart& part : parts_)
    {
        part.checkTopology(time.name());
    }
}


millfoam::averaging::MeshPoints
Foam::meshAssembly::points(const instant& time) const
{
    pointField result(nPoints_, Zero);
    for (const meshPart& part : parts_)
    {
        const bool start = time.value() == 0 && !part.hasPoints(time.name());
        UIndirectList<point>(result, part.pointLabels()) =
            part.points(start ? part.time().constant() : time.name());
    }
    return averagingPoints(result);
}


// ************************************************************************* //
