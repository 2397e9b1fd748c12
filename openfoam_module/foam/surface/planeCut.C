/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "planeCut.H"
#include "cellColumn.H"
#include "cutTriangles.H"

#include <array>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Share of a triangle's area below height d
scalar shareBelow(const heights& s, const scalar d)
{
    if (d <= s[0])
    {
        return 0;
    }
    if (d >= s[2])
    {
        return 1;
    }
    if (d <= s[1])
    {
        return sqr(d - s[0]) / ((s[1] - s[0]) * (s[2] - s[0]));
    }
    return 1 - sqr(s[2] - d) / ((s[2] - s[0]) * (s[2] - s[1]));
}


//- Integral of shareBelow from below the triangle to height d
scalar integralBelow(const heights& s, const scalar d)
{
    if (d <= s[0])
    {
        return 0;
    }
    const scalar mean = (s[0] + s[1] + s[2]) / 3;
    if (d >= s[2])
    {
        return d - mean;
    }
    if (d <= s[1])
    {
        return pow3(d - s[0]) / (3 * (s[1] - s[0]) * (s[2] - s[0]));
    }
    return d - mean + pow3(s[2] - d) / (3 * (s[2] - s[0]) * (s[2] - s[1]));
}


//- Where the segment from a to b, at heights sa and sb, meets height d
point crossing(
    const point& a, const point& b, const scalar sa, const scalar sb,
    const scalar d)
{
    return a + (d - sa) / (sb - sa) * (b - a);
}


//- Where the plane n & x = level cuts two sides of a triangle with corners x.
//  False where it misses the triangle
bool crossSides(
    const std::array<point, 3>& x, const vector& n, const scalar level,
    std::array<point, 2>& ends)
{
    label found = 0;
    for (label i = 0; i < 3; ++i)
    {
        const point& p = x[i];
        const point& q = x[(i + 1) % 3];
        const scalar sp = n & p;
        const scalar sq = n & q;
        if ((sp < level) != (sq < level) && found < 2)
        {
            ends[found++] = crossing(p, q, sp, sq, level);
        }
    }
    return found == 2;
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::planeCut::planeCut(const fvMesh& mesh)
: mesh_(mesh)
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::planeCut::wetVolume(
    const label celli, const vector& n, const scalar d) const
{
    return cellColumn(mesh_, celli, n)
        .below(d - (n & mesh_.cellCentres()[celli]))
        .volume;
}


Foam::scalar Foam::planeCut::offset(
    const label celli, const vector& n, const scalar alpha,
    const scalar guess) const
{
    const cellColumn column(mesh_, celli, n);
    const scalar base = n & mesh_.cellCentres()[celli];
    const scalar whole = column.below(column.high()).volume;
    scalar low = column.low();
    scalar high = column.high();

    // Newton's steps, halves where they leave the bracket; V(d) is monotone
    // and smooth
    scalar level = guess - base;
    if (!(level > low && level < high))
    {
        level = low + alpha * (high - low);
    }
    for (label i = 0; i < 100 && high - low > 1e-15 * (mag(low) + mag(high));
         ++i)
    {
        const cellColumn::part part(column.below(level));
        const scalar error = part.volume / whole - alpha;
        if (mag(error) < 4e-15)
        {
            return base + level;
        }
        (error < 0 ? low : high) = level;
        const scalar step = error * whole / max(part.area, VSMALL);
        level -= step;
        if (!(level > low && level < high))
        {
            level = 0.5 * (low + high);
        }
    }
    return base + 0.5 * (low + high);
}


Foam::planeCut::section
Foam::planeCut::cut(const label celli, const vector& n, const scalar d) const
{
    const point& origin = mesh_.cellCentres()[celli];
    const scalar level = d - (n & origin);
    const point centre(origin + level * n);

    // Each triangle that is cut gives one side of the polygon in the plane,
    // seen from its centre
    scalar area = 0;
    vector moment(Zero);
    forOutwardTriangles(
        mesh_, celli,
        [&](const point& a, const point& b, const point& c)
        {
            const std::array<point, 3> x{a - origin, b - origin, c - origin};
            std::array<point, 2> ends;
            if (!crossSides(x, n, level, ends))
            {
                return;
            }
            const vector u(ends[0] - level * n);
            const vector v(ends[1] - level * n);
            const vector outward((x[1] - x[0]) ^ (x[2] - x[0]));
            const scalar sense = ((n ^ outward) & (v - u)) > 0 ? 0.5 : -0.5;
            const scalar part = sense * (n & (u ^ v));
            area += part;
            moment += part * (u + v) / 3;
        });

    if (area <= VSMALL)
    {
        return {centre, 0};
    }
    return {centre + moment / area, area};
}


Foam::scalar Foam::planeCut::wetShare(
    const label facei, const vector& n, const scalar d0, const scalar d1) const
{
    const point& origin = mesh_.faceCentres()[facei];
    const vector& normal = mesh_.faceAreas()[facei];
    const scalar base = n & origin;
    const scalar from = d0 - base;
    const scalar to = d1 - base;

    scalar wet = 0;
    scalar whole = 0;
    forTriangles(
        mesh_, facei,
        [&](const point& a, const point& b, const point& c)
        {
            const heights s(sortedHeights(
                n & (a - origin), n & (b - origin), n & (c - origin)));
            const scalar area = ((b - a) ^ (c - a)) & normal;
            const scalar share =
                mag(to - from) > 1e-6 * (s[2] - s[0])
                    ? (integralBelow(s, to) - integralBelow(s, from)) /
                          (to - from)
                    : shareBelow(s, 0.5 * (from + to));
            wet += area * share;
            whole += area;
        });
    return min(max(wet / whole, scalar(0)), scalar(1));
}


// ************************************************************************* //
