/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsBlocks.H"
#include "ListOps.H"
#include "volFields.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::solidsBlocks::setBoxes(const fvMesh& mesh, const bool moved)
{
    bool needed = false;
    for (const solidsBlock& block : blocks_)
    {
        needed = needed || block.needsBoxes();
    }
    if (!needed || (boxes_.size() == mesh.nCells() && !moved))
        return;

    boxes_.setSize(mesh.nCells());
    forAll(boxes_, celli)
    {
        boxes_[celli] = boundBox(mesh.points(), mesh.cellPoints(celli), false);
    }
}


void Foam::solidsBlocks::checkRoom(const solidsFields& sums) const
{
    const scalarField& solidity = sums.solidity();
    forAll(solidity, celli)
    {
        if (solidity[celli] >= 1)
        {
            FatalIOErrorInFunction(dict_)
                << "the blocks together have the solidity " << solidity[celli]
                << " in cell " << celli << "; expected less than 1"
                << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsBlocks::solidsBlocks(const dictionary& dict)
: dict_(dict),
  blocks_(),
  boxes_(),
  time_(0),
  sampled_(false)
{
    if (dict.isDict("block"))
    {
        blocks_.append(new solidsBlock(dict.subDict("block")));
        return;
    }
    const dictionary& all = dict.subDict("blocks");
    if (all.empty())
    {
        FatalIOErrorInFunction(dict)
            << "blocks is empty; expected one block or more, NAME { … }"
            << exit(FatalIOError);
    }
    for (const entry& one : all)
    {
        blocks_.append(new solidsBlock(all.subDict(one.keyword())));
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::solidsBlocks::sample(
    const fvMesh& mesh, const scalar time, const bool moved, solidsFields& sums)
{
    bool changed = !sampled_ || moved;
    for (const solidsBlock& block : blocks_)
    {
        changed = changed || block.changes(time_, time);
    }
    time_ = time;
    sampled_ = true;
    if (!changed)
        return false;

    setBoxes(mesh, moved);
    sums.clear(mesh.nCells());
    for (const solidsBlock& block : blocks_)
    {
        block.add(mesh, boxes_, time, sums);
    }
    checkRoom(sums);
    return true;
}


bool Foam::solidsBlocks::knowsVolume() const
{
    bool known = true;
    for (const solidsBlock& block : blocks_)
    {
        known = known && block.knowsVolume();
    }
    return known;
}


Foam::scalar Foam::solidsBlocks::volume() const
{
    scalar sum = 0;
    for (const solidsBlock& block : blocks_)
    {
        sum += block.volume(time_);
    }
    return sum;
}


Foam::string Foam::solidsBlocks::description() const
{
    string text;
    for (const solidsBlock& block : blocks_)
    {
        text += (text.empty() ? "" : "; ") + block.description();
    }
    return text;
}


// ************************************************************************* //
