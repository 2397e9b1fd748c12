/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidsRecord.H"
#include "untrapped.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<millfoam::averaging::Interpolation>
    Foam::solidsRecord::interpolationNames_({
        {millfoam::averaging::Interpolation::cell, "cell"},
        {millfoam::averaging::Interpolation::linear, "linear"},
    });


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using millfoam::averaging::LocalSolids;
using millfoam::averaging::MeshCells;

//- Samples a window at a point of whatever grid a file has
struct pointSampler
{
    const millfoam::averaging::SolidsWindow& window;
    const point& p;
    millfoam::averaging::Interpolation interpolation;

    template <class Grid> LocalSolids operator()(const Grid& grid) const
    {
        return millfoam::averaging::sample(
            grid, window, {p.x(), p.y(), p.z()}, interpolation);
    }

    //- Fields on cells are not looked up by points
    LocalSolids operator()(const MeshCells&) const
    {
        return LocalSolids();
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::solidsRecord::open(const Time& time)
{
    if (!file_.isAbsolute())
    {
        file_ = time.globalPath() / file_;
    }

    const auto failure = untrapped(
        [this]()
        {
            reader_ = std::make_unique<millfoam::averaging::SolidsReader>(
                std::string(file_));
        });
    if (failure)
    {
        FatalIOErrorInFunction(dict_) << *failure << exit(FatalIOError);
    }
}


void Foam::solidsRecord::checkMeshTime(const MeshCells& cells) const
{
    if (!cells.motion.empty() &&
        mag(cells.time - reader_->time0()) > reader_->timestep())
    {
        WarningInFunction
            << file_ << ": the mesh " << cells.file.c_str()
            << " holds for DEM time " << scalar(cells.time)
            << " s but the solids begin at " << reader_->time0()
            << " s, which is flow time 0: the flow's mesh is not where the"
            << " solids' was. Make the mesh with millMesh --at-time "
            << reader_->time0() << " or average from --start "
            << scalar(cells.time) << endl;
    }
}


void Foam::solidsRecord::readInterpolation()
{
    using millfoam::averaging::Interpolation;

    if (!cells_.valid())
    {
        interpolation_ = interpolationNames_.get("interpolation", dict_);
        return;
    }

    interpolation_ = interpolationNames_.getOrDefault(
        "interpolation", dict_, Interpolation::cell);
    if (interpolation_ != Interpolation::cell)
    {
        FatalIOErrorInFunction(dict_)
            << "interpolation is " << interpolationNames_[interpolation_]
            << " but " << file_ << " holds solids on the cells of the mesh;"
            << " expected cell, or no such entry" << exit(FatalIOError);
    }
}


void Foam::solidsRecord::loadWindow(const scalar t)
{
    const label wanted = clock_->windowAt(t);
    if (wanted == number_)
    {
        return;
    }

    const auto failure =
        untrapped([&]() { window_ = reader_->read_window(wanted); });
    if (failure)
    {
        FatalIOErrorInFunction(dict_) << *failure << exit(FatalIOError);
    }
    number_ = wanted;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidsRecord::solidsRecord(const dictionary& dict, const fvMesh& mesh)
: dict_(dict),
  file_(dict.get<fileName>("solids").expand()),
  interpolation_(),
  number_(-1)
{
    open(mesh.time());
    clock_.reset(new solidsClock(dict, file_, *reader_));
    clock_->checkSpan(mesh.time());

    if (const auto* cells = std::get_if<MeshCells>(&reader_->grid()))
    {
        cells_.reset(new solidsCells(dict, file_, mesh, *cells));
        checkMeshTime(*cells);
    }
    readInterpolation();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::solidsRecord::sample(
    const fvMesh& mesh, scalarField& solidity, vectorField& velocity,
    scalarField& diameter)
{
    loadWindow(mesh.time().value());
    if (cells_.valid())
    {
        cells_->pick(window_, solidity, velocity, diameter);
        return 0;
    }

    label uncovered = 0;
    const vectorField& centres = mesh.C().primitiveField();
    forAll(centres, i)
    {
        const LocalSolids solids = std::visit(
            pointSampler{window_, centres[i], interpolation_}, reader_->grid());
        solidity[i] = solids.solidity;
        velocity[i] =
            vector(solids.velocity[0], solids.velocity[1], solids.velocity[2]);
        diameter[i] = solids.diameter;
        uncovered += solids.inside ? 0 : 1;
    }
    return uncovered;
}


Foam::string Foam::solidsRecord::description() const
{
    return clock_->description() + ", " +
           (cells_.valid()
                ? "on the mesh's cells"
                : interpolationNames_[interpolation_] + " interpolation");
}


// ************************************************************************* //
