/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsFields.H"
#include "UIndirectList.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::solidsFields::clear(const label n)
{
    solidity_.setSize(n);
    flux_.setSize(n);
    overDiameter_.setSize(n);
    timesDiameter_.setSize(n);

    solidity_ = Zero;
    flux_ = Zero;
    overDiameter_ = Zero;
    timesDiameter_ = Zero;
}


void Foam::solidsFields::add(
    const label celli, const scalar phi, const vector& u, const scalar d32,
    const scalar d43)
{
    if (phi <= 0)
        return;

    solidity_[celli] += phi;
    flux_[celli] += phi * u;
    overDiameter_[celli] += phi / d32;
    timesDiameter_[celli] += phi * d43;
}


void Foam::solidsFields::empty(const labelUList& cells)
{
    UIndirectList<scalar>(solidity_, cells) = Zero;
    UIndirectList<vector>(flux_, cells) = vector(Zero);
    UIndirectList<scalar>(overDiameter_, cells) = Zero;
    UIndirectList<scalar>(timesDiameter_, cells) = Zero;
}


void Foam::solidsFields::blend(
    const std::array<const solidsFields*, 3>& solids,
    const std::array<double, 3>& shares)
{
    const auto sum = [&](const auto field)
    {
        return shares[0] * (solids[0]->*field) +
               shares[1] * (solids[1]->*field) +
               shares[2] * (solids[2]->*field);
    };
    solidity_ = sum(&solidsFields::solidity_);
    flux_ = sum(&solidsFields::flux_);
    overDiameter_ = sum(&solidsFields::overDiameter_);
    timesDiameter_ = sum(&solidsFields::timesDiameter_);
}


Foam::vector Foam::solidsFields::velocity(const label celli) const
{
    const scalar phi = solidity_[celli];
    return phi > 0 ? flux_[celli] / phi : vector::zero;
}


Foam::scalar Foam::solidsFields::diameter(const label celli) const
{
    const scalar phi = solidity_[celli];
    return phi > 0 ? phi / overDiameter_[celli] : 0;
}


Foam::scalar Foam::solidsFields::diameter43(const label celli) const
{
    const scalar phi = solidity_[celli];
    return phi > 0 ? timesDiameter_[celli] / phi : 0;
}


// ************************************************************************* //
