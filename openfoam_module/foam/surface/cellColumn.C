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


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::cellColumn::add(const std::array<vector, 3>& corners)
{
    const auto& [a, b, c] = corners;
    const vector area(0.5 * ((b - a) ^ (c - a)));
    const heights s(sortedHeights(n_ & a, n_ & b, n_ & c));
    const scalar height = s[2] - s[0];
    facet added;
    added.lowest = s[0];
    added.middle = s[1];
    added.highest = s[2];
    added.rise = 1 / max((s[1] - s[0]) * height, VSMALL);
    added.fall = 1 / max((s[2] - s[1]) * height, VSMALL);
    added.cone = a & area;
    added.taken = n_ & area;
    low_ = min(low_, s[0]);
    high_ = max(high_, s[2]);
    volume_ += added.cone / 3;
    facets_.push_back(added);
    corners_.push_back(corners);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellColumn::cellColumn()
: n_(Zero),
  facets_(),
  corners_(),
  low_(GREAT),
  high_(-GREAT),
  volume_(0)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::cellColumn::set(
    const fvMesh& mesh, const label celli, const vector& n)
{
    n_ = n;
    facets_.clear();
    corners_.clear();
    low_ = GREAT;
    high_ = -GREAT;
    volume_ = 0;
    const point& origin = mesh.cellCentres()[celli];
    forOutwardTriangles(
        mesh, celli,
        [&](const point& a, const point& b, const point& c) {
            add({a - origin, b - origin, c - origin});
        });
}


Foam::cellColumn::part Foam::cellColumn::below(const scalar level) const
{
    part sum{0, 0, 0, 0};
    for (const facet& t : facets_)
    {
        if (level <= t.lowest)
        {
            continue;
        }
        const scalar cone = t.cone - level * t.taken;
        scalar share = 1;
        if (level < t.highest)
        {
            const bool lower = level <= t.middle;
            const scalar way = lower ? level - t.lowest : t.highest - level;
            const scalar curve = lower ? t.rise : -t.fall;
            const scalar rate = 2 * way * mag(curve);
            share = lower ? 0.5 * way * rate : 1 - 0.5 * way * rate;
            sum.slope += rate * cone;
            sum.bend += curve * cone - rate * t.taken;
            sum.twist -= curve * t.taken;
        }
        sum.volume += share * cone;
        sum.slope -= share * t.taken;
    }
    return {sum.volume / 3, sum.slope / 3, sum.bend / 3, sum.twist / 3};
}


Foam::cellColumn::section Foam::cellColumn::cut(const scalar level) const
{
    // Each triangle that is cut gives one side of the polygon in the plane,
    // seen from the foot of the cell's centre, with the normal on its left
    const vector foot(level * n_);
    scalar area = 0;
    vector moment(Zero);
    for (std::size_t i = 0; i < facets_.size(); ++i)
    {
        if (!(facets_[i].lowest < level && facets_[i].highest >= level))
        {
            continue;
        }
        const std::array<vector, 3>& x = corners_[i];
        const heights s{n_ & x[0], n_ & x[1], n_ & x[2]};
        const std::array<bool, 3> below{
            s[0] < level, s[1] < level, s[2] < level};
        // The corner that is alone on its side of the plane
        const std::size_t alone = below[1] == below[2]   ? 0
                                  : below[0] == below[2] ? 1
                                                         : 2;
        const std::size_t next = (alone + 1) % 3;
        const std::size_t last = (alone + 2) % 3;
        vector u(crossing(x[alone], x[next], s[alone], s[next], level) - foot);
        vector v(crossing(x[alone], x[last], s[alone], s[last], level) - foot);
        if (below[alone])
        {
            std::swap(u, v);
        }
        const scalar side = 0.5 * (n_ & (u ^ v));
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
