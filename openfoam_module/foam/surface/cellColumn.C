/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellColumn.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Inverse of a product of heights' differences; 0 where two corners are level
static scalar inverse(const scalar product)
{
    return product > VSMALL ? 1 / product : 0;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellColumn::cellColumn(
    const fvMesh& mesh, const label celli, const vector& n)
: facets_(),
  low_(GREAT),
  high_(-GREAT)
{
    const point& origin = mesh.cellCentres()[celli];
    facets_.reserve(4 * mesh.cells()[celli].size());
    forOutwardTriangles(
        mesh, celli,
        [&](const point& a, const point& b, const point& c)
        {
            const vector ra(a - origin), rb(b - origin), rc(c - origin);
            const heights s(sortedHeights(n & ra, n & rb, n & rc));
            const vector area(0.5 * ((rb - ra) ^ (rc - ra)));
            const scalar height = s[2] - s[0];
            facets_.push_back(
                {s, ra & area, n & area, inverse(height * (s[1] - s[0])),
                 inverse(height * (s[2] - s[1]))});
            low_ = min(low_, s[0]);
            high_ = max(high_, s[2]);
        });
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::cellColumn::part Foam::cellColumn::below(const scalar level) const
{
    scalar volume = 0;
    scalar growth = 0;
    for (const facet& t : facets_)
    {
        if (level <= t.s[0])
        {
            continue;
        }
        scalar share = 1;
        scalar rate = 0;
        if (level <= t.s[1])
        {
            const scalar up = level - t.s[0];
            share = sqr(up) * t.overLower;
            rate = 2 * up * t.overLower;
        }
        else if (level < t.s[2])
        {
            const scalar down = t.s[2] - level;
            share = 1 - sqr(down) * t.overUpper;
            rate = 2 * down * t.overUpper;
        }
        const scalar cone = t.cone - level * t.taken;
        volume += share * cone;
        growth += rate * cone - share * t.taken;
    }
    return {volume / 3, growth / 3};
}


// ************************************************************************* //
