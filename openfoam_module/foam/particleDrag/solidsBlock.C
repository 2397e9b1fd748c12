/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsBlock.H"
#include "OStringStream.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsBlock::solidsBlock(const dictionary& dict)
: box_(),
  solidity_(dict.get<scalar>("solidity")),
  velocity_(dict.get<vector>("velocity")),
  diameter_(dict.get<scalar>("diameter"))
{
    dict.lookup("box") >> box_.min() >> box_.max();

    if (!(solidity_ >= 0 && solidity_ < 1))
    {
        FatalIOErrorInFunction(dict)
            << "solidity is " << solidity_ << "; expected 0 <= solidity < 1"
            << exit(FatalIOError);
    }
    if (!(diameter_ > 0))
    {
        FatalIOErrorInFunction(dict)
            << "diameter is " << diameter_ << "; expected a length above 0 m"
            << exit(FatalIOError);
    }
    if (!(cmptMin(box_.span()) > 0))
    {
        FatalIOErrorInFunction(dict)
            << "box is " << box_ << "; expected the lower corner first"
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::solidsBlock::sample(
    const fvMesh& mesh, scalarField& solidity, vectorField& velocity,
    scalarField& diameter)
{
    const vectorField& centres = mesh.C().primitiveField();
    forAll(centres, i)
    {
        const bool inside = box_.contains(centres[i]);
        solidity[i] = inside ? solidity_ : 0;
        velocity[i] = inside ? velocity_ : vector::zero;
        diameter[i] = inside ? diameter_ : 0;
    }
    return 0;
}


Foam::string Foam::solidsBlock::description() const
{
    OStringStream text;
    text << "uniform bed of solidity " << solidity_ << ", velocity "
         << velocity_ << " m/s, diameter " << diameter_ << " m in " << box_;
    return text.str();
}


// ************************************************************************* //
