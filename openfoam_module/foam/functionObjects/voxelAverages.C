/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "voxelAverages.H"
#include "addToRunTimeSelectionTable.H"

#include <algorithm>
#include <array>
#include <numeric>

using namespace millfoam::averaging;

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(voxelAverages, 0);
addToRunTimeSelectionTable(functionObject, voxelAverages, dictionary);
} // End namespace functionObjects
} // End namespace Foam


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The entry divisions
static label divisions(const dictionary& dict)
{
    const label number = dict.lookupOrDefault<label>("divisions", 1);
    if (number < 1 || number > 10)
    {
        FatalIOErrorInFunction(dict)
            << "divisions is " << number << "; expected 1 to 10"
            << exit(FatalIOError);
    }
    return number;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

std::vector<double> Foam::functionObjects::voxelAverages::cellValues() const
{
    const scalarField voidage(fields_.voidage());
    const scalarField& alpha = fields_.alpha().primitiveField();
    const vectorField& U = fields_.U().primitiveField();
    const scalarField& p = fields_.p().primitiveField();
    const scalarField& p_rgh = fields_.p_rgh().primitiveField();
    std::vector<double> values(alpha.size() * segments_.components());
    auto* cell = values.data();
    forAll(alpha, celli)
    {
        const scalar slurry = voidage[celli] * alpha[celli];
        const vector flux(slurry * U[celli]);
        const std::array<double, slurry_components> own{
            slurry,
            voidage[celli],
            flux.x(),
            flux.y(),
            flux.z(),
            slurry * p[celli],
            slurry * p_rgh[celli]};
        std::copy(own.begin(), own.end(), cell);
        cell += segments_.components();
    }
    if (balls_)
    {
        addBallComponents(
            balls_->present(), balls_->flow(), alpha, U, values,
            segments_.components(), slurry_components);
    }
    return values;
}


VoxelSums Foam::functionObjects::voxelAverages::sample()
{
    return cells_.sum(segments_.grid(), cellValues(), segments_.components());
}


void Foam::functionObjects::voxelAverages::checkBox()
{
    // The fields may not be known yet
    const VoxelSums sums(cells_.sum(segments_.grid(), {}, 0));
    const scalar inside = returnReduce(
        std::accumulate(sums.volume.begin(), sums.volume.end(), scalar(0)),
        sumOp<scalar>());
    if (!(inside > 0))
    {
        FatalErrorInFunction
            << name() << ": no part of the mesh, which reaches from "
            << mesh_.bounds().min() << " to " << mesh_.bounds().max()
            << " m, lies in " << segments_.boxDescription().c_str()
            << "; expected a box (lower, upper) that covers the mesh, in m"
            << exit(FatalError);
    }
}


void Foam::functionObjects::voxelAverages::warnOutside(
    const scalar slurry, const scalar outside, const string& when) const
{
    if (outside > 0.01 * slurry)
    {
        WarningInFunction << name() << ": " << 100 * outside / slurry
                          << " % of the slurry lies beyond "
                          << segments_.boxDescription().c_str() << " "
                          << when.c_str() << "; the mesh reaches from "
                          << mesh_.bounds().min() << " to "
                          << mesh_.bounds().max() << " m" << endl;
    }
}


void Foam::functionObjects::voxelAverages::sampleUpToNow()
{
    const scalar now = mesh_.time().value();
    if (!(now > last_))
    {
        return;
    }
    const VoxelSums sums(sample());
    const scalar slurry = sum(fields_.volumes()());
    scalar inside = 0;
    for (std::size_t n = 0; n < sums.values.size(); n += sums.components)
    {
        inside += sums.values[n];
    }
    const scalar all = returnReduce(slurry, sumOp<scalar>());
    const scalar beyond = all - returnReduce(inside, sumOp<scalar>());
    if (slurry_ <= 0)
    {
        warnOutside(all, beyond, "at the first sample");
    }
    slurry_ += all * (now - last_);
    outside_ += beyond * (now - last_);

    segments_.add(sums, slurry, last_, now);
    last_ = now;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::voxelAverages::voxelAverages(
    const word& name, const Time& runTime, const dictionary& dict)
: fvMeshFunctionObject(name, runTime, dict),
  fields_(mesh_, dict),
  balls_(mesh_.findObject<fluidOnBalls>(fluidOnBalls::typeName)),
  segments_(name, runTime, dict, balls_),
  interval_(dict.lookupOrDefault<scalar>("interval", 0)),
  cells_(mesh_, divisions(dict)),
  last_(runTime.value()),
  slurry_(0),
  outside_(0)
{
    slurryFields::refuseOthers(
        dict, {"lower", "upper", "shape", "periodic", "window", "start",
               "interval", "divisions", "file"});
    const scalar window = dict.get<scalar>("window");
    if (!(interval_ >= 0 && interval_ <= window))
    {
        FatalIOErrorInFunction(dict)
            << "interval is " << interval_ << " s; expected a time from 0 to"
            << " the window, " << window << " s" << exit(FatalIOError);
    }
    checkBox();
    strict_.relax();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::voxelAverages::execute()
{
    const scalar now = mesh_.time().value();
    const bool written = mesh_.time().writeTime();
    // A time-step more would go beyond the interval
    const bool due =
        now - last_ + 0.5 * mesh_.time().deltaTValue() >= interval_;
    if (written || due)
    {
        sampleUpToNow();
    }
    if (written)
    {
        segments_.keep();
    }
    return true;
}


bool Foam::functionObjects::voxelAverages::write()
{
    return true;
}


bool Foam::functionObjects::voxelAverages::end()
{
    sampleUpToNow();
    warnOutside(slurry_, outside_, "in the mean of this run");
    segments_.keep();
    segments_.assemble();
    return true;
}


// ************************************************************************* //
