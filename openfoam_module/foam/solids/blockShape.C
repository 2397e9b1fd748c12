/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "blockShape.H"
#include "readableLog.H"
#include "Tuple2.H"
#include "knownEntries.H"
#include "mathematicalConstants.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::boxShape::rise> Foam::boxShape::riseNames_({
    {rise::cosine, "cosine"},
    {rise::linear, "linear"},
});


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::blockShape> Foam::blockShape::New(const dictionary& dict)
{
    const bool cylinder = dict.isDict("cylinder");
    if (cylinder == dict.found("box"))
    {
        FatalIOErrorInFunction(dict)
            << (cylinder ? "both" : "neither") << " of the entries 'box' and"
            << " 'cylinder' " << (cylinder ? "are" : "is")
            << " there; expected one of them" << exit(FatalIOError);
    }

    if (cylinder)
    {
        return autoPtr<blockShape>(new cylinderShape(dict.subDict("cylinder")));
    }
    return autoPtr<blockShape>(new boxShape(dict));
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::boxShape::lack(const scalar s, const scalar edge) const
{
    using constant::mathematical::pi;

    const scalar depth = max(scalar(0), min(s, edge));
    if (depth <= 0)
    {
        return 0;
    }
    const scalar filled =
        rise_ == rise::linear
            ? sqr(depth) / (2 * edge)
            : depth / 2 - edge / (2 * pi) * sin(pi * depth / edge);
    return depth - filled;
}


Foam::scalar Foam::boxShape::along(
    const direction axis, const scalar a, const scalar b) const
{
    const scalar lower = box_.min()[axis];
    const scalar upper = box_.max()[axis];
    const scalar first = max(a, lower);
    const scalar last = min(b, upper);
    if (last <= first)
    {
        return 0;
    }
    const scalar edge = edge_[axis];
    return (last - first) -
           (lack(last - lower, edge) - lack(first - lower, edge)) -
           (lack(upper - first, edge) - lack(upper - last, edge));
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::boxShape::boxShape(const dictionary& dict)
: box_(),
  rise_(riseNames_.getOrDefault("edgeShape", dict, rise::cosine)),
  edge_(
      dict.lookupOrDefault<scalar>("edge", 0) *
      dict.lookupOrDefault<vector>("edgeAxes", vector::one))
{
    dict.lookup("box") >> box_.min() >> box_.max();
    if (!(cmptMin(box_.span()) > 0))
    {
        FatalIOErrorInFunction(dict)
            << "box is " << box_ << "; expected the lower corner first"
            << exit(FatalIOError);
    }
    if (!(cmptMin(edge_) >= 0 && cmptMin(box_.span() - 2 * edge_) >= 0))
    {
        FatalIOErrorInFunction(dict)
            << "edges along the axes are " << edge_ << " m in a box of "
            << box_.span() << " m; expected 0 up to half of the box"
            << exit(FatalIOError);
    }
}


Foam::cylinderShape::cylinderShape(const dictionary& dict)
: centre_(dict.get<vector>("centre")),
  axis_(dict.get<vector>("axis")),
  radius_(dict.get<scalar>("radius")),
  begin_(0),
  end_(0)
{
    requireKnownEntries(dict, {"centre", "axis", "radius", "ends"});
    const Tuple2<scalar, scalar> ends(dict.lookup("ends"));
    begin_ = ends.first();
    end_ = ends.second();
    if (!(radius_ > 0 && end_ > begin_ && mag(axis_) > 0))
    {
        FatalIOErrorInFunction(dict)
            << "radius is " << radius_ << " m, ends are " << begin_ << " and "
            << end_ << " m, axis is " << axis_
            << "; expected a radius above 0, the lower end first and an axis"
            << " with a direction" << exit(FatalIOError);
    }
    axis_ /= mag(axis_);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::boxShape::entries() const
{
    return {"box", "edge", "edgeAxes", "edgeShape"};
}


Foam::wordList Foam::cylinderShape::entries() const
{
    return {"cylinder"};
}


Foam::scalar Foam::boxShape::at(const point& p) const
{
    using constant::mathematical::pi;

    if (!box_.contains(p))
    {
        return 0;
    }
    scalar share = 1;
    for (direction axis = 0; axis < vector::nComponents; ++axis)
    {
        const scalar depth =
            min(p[axis] - box_.min()[axis], box_.max()[axis] - p[axis]);
        if (depth < edge_[axis])
        {
            const scalar s = depth / edge_[axis];
            share *= rise_ == rise::linear ? s : (1 - cos(pi * s)) / 2;
        }
    }
    return share;
}


Foam::scalar Foam::boxShape::over(const boundBox& space) const
{
    scalar share = 1;
    for (direction axis = 0; axis < vector::nComponents; ++axis)
    {
        const scalar a = space.min()[axis];
        const scalar b = space.max()[axis];
        share *= along(axis, a, b) / (b - a);
    }
    return share;
}


Foam::string Foam::boxShape::description() const
{
    readableText text;
    text << "in " << box_;
    if (cmptMax(edge_) > 0)
    {
        text << " with " << riseNames_[rise_] << " edges of " << edge_ << " m";
    }
    return text.str();
}


Foam::scalar Foam::cylinderShape::at(const point& p) const
{
    const vector from(p - centre_);
    const scalar height = from & axis_;
    return height >= begin_ && height <= end_ &&
                   mag(from - height * axis_) <= radius_
               ? 1
               : 0;
}


Foam::scalar Foam::cylinderShape::over(const boundBox& space) const
{
    return at(space.midpoint());
}


Foam::string Foam::cylinderShape::description() const
{
    readableText text;
    text << "in a cylinder about " << centre_ << " along " << axis_
         << " of radius " << radius_ << " m from " << begin_ << " to " << end_
         << " m";
    return text.str();
}


// ************************************************************************* //
