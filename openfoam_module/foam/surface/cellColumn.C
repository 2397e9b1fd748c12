/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellColumn.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Where the segment from a to b, at heights sa and sb, meets height d
static point crossing(
    const point& a, const point& b, const scalar sa, const scalar sb,
    const scalar d)
{
    return a + (d - sa) / (sb - sa) * (b - a);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellColumn::cellColumn(
    const fvMesh& mesh, const label celli, const vector& n)
: n_(n),
  facets_(),
  low_(GREAT),
  high_(-GREAT)
{
    const point& origin = mesh.cellCentres()[celli];
    facets_.reserve(static_cast<std::size_t>(4 * mesh.cells()[celli].size()));
    forOutwardTriangles(
        mesh, celli,
        [&](const point& a, const point& b, const point& c)
        {
            std::array<vector, 3> x{a - origin, b - origin, c - origin};
            const vector area(0.5 * ((x[1] - x[0]) ^ (x[2] - x[0])));
            const scalar cone = x[0] & area;
            heights s{n & x[0], n & x[1], n & x[2]};
            const auto order = [&](const std::size_t i, const std::size_t j)
            {
                if (s[i] > s[j])
                {
                    std::swap(s[i], s[j]);
                    std::swap(x[i], x[j]);
                }
            };
            order(0, 1);
            order(1, 2);
            order(0, 1);
            facets_.push_back({x, s, area, cone, n & area});
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
        if (level < t.s[2])
        {
            const bool lower = level <= t.s[1];
            const scalar way = lower ? level - t.s[0] : t.s[2] - level;
            const scalar side = lower ? t.s[1] - t.s[0] : t.s[2] - t.s[1];
            const scalar product = (t.s[2] - t.s[0]) * side;
            // Two level corners leave no part on this side of the middle one
            rate = product > VSMALL ? 2 * way / product : 0;
            share = lower ? 0.5 * way * rate : 1 - 0.5 * way * rate;
        }
        const scalar cone = t.cone - level * t.taken;
        volume += share * cone;
        growth += rate * cone - share * t.taken;
    }
    return {volume / 3, growth / 3};
}


Foam::cellColumn::section Foam::cellColumn::cut(const scalar level) const
{
    // Each triangle that is cut gives one side of the polygon in the plane,
    // seen from the foot of the cell's centre
    const vector foot(level * n_);
    scalar area = 0;
    vector moment(Zero);
    for (const facet& t : facets_)
    {
        if (!(t.s[0] < level && t.s[2] >= level))
        {
            continue;
        }
        const std::size_t from = t.s[1] < level ? 1 : 0;
        const std::size_t to = t.s[1] < level ? 2 : 1;
        const vector u(crossing(t.x[0], t.x[2], t.s[0], t.s[2], level) - foot);
        const vector v(
            crossing(t.x[from], t.x[to], t.s[from], t.s[to], level) - foot);
        const scalar sense = ((n_ ^ t.area) & (v - u)) > 0 ? 0.5 : -0.5;
        const scalar side = sense * (n_ & (u ^ v));
        area += side;
        moment += side * (u + v) / 3;
    }
    if (area <= VSMALL)
    {
        return {foot, 0};
    }
    return {foot + moment / area, area};
}


// ************************************************************************* //
