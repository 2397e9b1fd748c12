/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "planeCut.H"
#include "cutTriangles.H"

#include <array>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Error of a share that counts as none
constexpr scalar roundOff = 4e-15;


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


//- Step from a level to a volume, with an allowed error of it, by the cubic
//  around the level: outside of the bounds, or as far as 20 Newton steps come,
//  where the cubic does not get there
scalar stepTo(
    const cellColumn::part& part, const scalar volume, const scalar allowed,
    const scalar least, const scalar most)
{
    scalar step = 0;
    for (label i = 0; i < 20 && step >= least && step <= most; ++i)
    {
        const scalar error =
            part.volume - volume +
            step * (part.slope + step * (part.bend + step * part.twist));
        if (mag(error) < allowed)
        {
            break;
        }
        const scalar slope =
            part.slope + step * (2 * part.bend + step * 3 * part.twist);
        step -= error / max(slope, VSMALL);
    }
    return step;
}


//- Level, from the cell's centre, that leaves a share below it; guess: a level
scalar levelOf(const cellColumn& column, const scalar share, const scalar guess)
{
    const scalar volume = share * column.volume();
    const scalar allowed = roundOff * column.volume();
    scalar low = column.low();
    scalar high = column.high();

    // Steps of the cubic that the volume is around a level, halves where they
    // leave the bracket; V(d) is monotone and smooth
    scalar level = guess;
    if (!(level > low && level < high))
    {
        level = low + share * (high - low);
    }
    for (label i = 0; i < 100 && high - low > 1e-15 * (mag(low) + mag(high));
         ++i)
    {
        const cellColumn::part part(column.below(level));
        const scalar error = part.volume - volume;
        if (mag(error) < allowed)
        {
            return level;
        }
        (error < 0 ? low : high) = level;
        level += stepTo(part, volume, 0.1 * allowed, low - level, high - level);
        if (!(level > low && level < high))
        {
            level = 0.5 * (low + high);
        }
    }
    return 0.5 * (low + high);
}

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::planeCut::planeCut(const fvMesh& mesh)
: mesh_(mesh),
  column_()
{
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::planeCut::wetVolume(
    const label celli, const vector& n, const scalar d) const
{
    column_.set(mesh_, celli, n);
    return column_.below(d - (n & mesh_.cellCentres()[celli])).volume;
}


Foam::scalar Foam::planeCut::offset(
    const label celli, const vector& n, const scalar alpha,
    const scalar guess) const
{
    column_.set(mesh_, celli, n);
    const scalar base = n & mesh_.cellCentres()[celli];
    return base + levelOf(column_, alpha, guess - base);
}


Foam::planeCut::placement Foam::planeCut::place(
    const label celli, const vector& n, const scalar alpha,
    const scalar guess) const
{
    column_.set(mesh_, celli, n);
    const scalar level = levelOf(column_, alpha, guess);
    return {level, column_.cut(level)};
}


Foam::planeCut::section
Foam::planeCut::cut(const label celli, const vector& n, const scalar d) const
{
    const point& origin = mesh_.cellCentres()[celli];
    column_.set(mesh_, celli, n);
    section result(column_.cut(d - (n & origin)));
    result.centre += origin;
    return result;
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
