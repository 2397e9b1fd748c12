/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "averageSegments.H"
#include "cellsOnVoxels.H"
#include "optionalDictionary.H"
#include "IOdictionary.H"
#include "OSspecific.H"
#include "readableLog.H"
#include "Pstream.H"
#include "Switch.H"
#include "untrapped.H"
#include "vector.H"
#include "millfoam_version.hpp"

#include <algorithm>
#include <cstdio>

using namespace millfoam::averaging;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Times closer than this are the same, s
static constexpr scalar instant_ = 1e-9;

//- A window that is not much longer would end at each of them, s
static constexpr scalar shortest_ = 1e-6;


//- The box of the entries lower, upper, shape and periodic
static BoxGrid readGrid(const dictionary& dict)
{
    const vector lower(dict.get<vector>("lower"));
    const vector upper(dict.get<vector>("upper"));
    const FixedList<label, 3> shape(dict.get<FixedList<label, 3>>("shape"));
    const FixedList<Switch, 3> periodic(
        dict.lookupOrDefault("periodic", FixedList<Switch, 3>(Switch(false))));

    std::unique_ptr<BoxGrid> grid;
    const auto reason = untrapped(
        [&]
        {
            grid = std::make_unique<BoxGrid>(
                Vector3{lower.x(), lower.y(), lower.z()},
                Vector3{upper.x(), upper.y(), upper.z()},
                VoxelIndex{int(shape[0]), int(shape[1]), int(shape[2])},
                std::array<bool, 3>{periodic[0], periodic[1], periodic[2]});
        });
    if (reason)
    {
        FatalIOErrorInFunction(dict)
            << "lower " << lower << ", upper " << upper << ", shape " << shape
            << ": " << reason->c_str() << exit(FatalIOError);
    }
    return *grid;
}


//- What the force on balls is computed with
static std::optional<BallsHeader> ballsHeader(const fluidOnBalls* balls)
{
    if (!balls)
    {
        return std::nullopt;
    }
    const ballsInFlow& flow = balls->flow();
    return BallsHeader{
        flow.law,
        flow.polydispersity,
        flow.slurryDensity,
        flow.airDensity,
        {flow.gravity.x(), flow.gravity.y(), flow.gravity.z()}};
}


//- The file that the averages are for, in a folder that is there
static fileName fileOf(const dictionary& dict, const Time& time)
{
    fileName file(dict.lookupOrDefault<fileName>("file", "slurry.h5"));
    if (!file.isAbsolute())
    {
        file = time.globalPath() / file;
    }
    file.clean();
    if (Pstream::master() && !isDir(file.path()))
    {
        FatalIOErrorInFunction(dict)
            << "file is " << file << ", and there is no folder " << file.path()
            << "; expected a file's name in a folder that is there"
            << exit(FatalIOError);
    }
    return file;
}


//- Refuse a file into which another function object of the case writes, too
static void refuseShared(
    const word& name, const fileName& file, const dictionary& dict,
    const Time& time)
{
    const dictionary all(time.controlDict().subOrEmptyDict("functions"));
    for (const entry& one : all)
    {
        if (one.isDict() && one.keyword() != name &&
            one.dict().lookupOrDefault<word>("type", "none") ==
                "voxelAverages" &&
            one.dict().lookupOrDefault("enabled", true) &&
            fileOf(one.dict(), time) == file)
        {
            FatalIOErrorInFunction(dict)
                << "file is " << file << " for both function objects " << name
                << " and " << one.keyword() << ", of which the second would"
                << " replace what the first has written; expected an entry"
                << " file of its own for each, as file \"" << one.keyword()
                << ".h5\";" << exit(FatalIOError);
        }
    }
}


//- Times of windows and of the run, and the balls
static SlurryHeader
readHeader(const dictionary& dict, const Time& time, const fluidOnBalls* balls)
{
    const IOdictionary mill(optionalDictionary("millProperties", time, false));
    SlurryHeader header;
    header.time0 = mill.lookupOrDefault<scalar>("time0", 0);
    header.window = dict.get<scalar>("window");
    header.start = dict.lookupOrDefault<scalar>("start", 0);
    header.program = std::string("voxelAverages ") + millfoam::version();
    header.balls = ballsHeader(balls);
    header.mill_flow = mill.lookupOrDefault<string>("flowFingerprint", "");
    if (!(header.window >= shortest_))
    {
        FatalIOErrorInFunction(dict)
            << "window is " << header.window
            << " s; expected a length of time above 0, at least " << shortest_
            << " s" << exit(FatalIOError);
    }
    if (header.start >= time.endTime().value())
    {
        FatalIOErrorInFunction(dict)
            << "start is " << scalar(header.start) << " s; expected a time"
            << " before the flow's end, " << time.endTime().value()
            << " s: there would be no mean over the run" << exit(FatalIOError);
    }
    return header;
}


//- Begin and end of a segment, s, by its file's name
static FixedList<scalar, 2> timesOf(const fileName& file)
{
    FixedList<scalar, 2> result(Zero);
    std::sscanf(file.name().c_str(), "%lf_%lf.h5", &result[0], &result[1]);
    return result;
}


//- Stop the run with what a file could not do
static void stopWith(const std::optional<std::string>& reason)
{
    if (reason)
    {
        FatalErrorInFunction << reason->c_str() << exit(FatalError);
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::averageSegments::segmentEnd(const scalar t) const
{
    const scalar window =
        header_.window * (std::floor((t + instant_) / header_.window) + 1);
    return header_.start > t + instant_ ? min(window, scalar(header_.start))
                                        : window;
}


void Foam::averageSegments::dropLater() const
{
    // The name of the time from which a flow resumes is rounded. A segment that
    // ends a little later may have ended there, one mostly beyond it did not
    const scalar now = time_.value() + max(0.5 * time_.deltaTValue(), instant_);
    for (const std::filesystem::path& path : files())
    {
        const FixedList<scalar, 2> times(timesOf(path.string()));
        if (times[1] > now || times[0] + times[1] > 2 * time_.value())
        {
            rm(path.string());
            if (times[0] < now - time_.deltaTValue())
            {
                WarningInFunction
                    << path.string() << " goes beyond the time "
                    << time_.timeName()
                    << " s from which the flow resumes, and is removed: its"
                    << " window will be marked as not filled" << endl;
            }
        }
    }
}


void Foam::averageSegments::check() const
{
    for (const std::filesystem::path& path : files())
    {
        stopWith(untrapped(
            [&]
            {
                window_of(
                    read_segment(path, grid_, withBalls()), header_.window,
                    path.string());
            }));
    }
}


void Foam::averageSegments::keepEarlier() const
{
    const std::vector<std::filesystem::path> kept(files());
    const scalar begin =
        kept.empty() ? time_.value() : timesOf(kept.front().string())[0];
    const std::optional<double> found = slurry_begin(file_.c_str());
    // Names of times are rounded
    if (found && *found < begin - 1e-3 * header_.window)
    {
        FatalErrorInFunction
            << file_ << " begins at the flow time " << scalar(*found)
            << " s, and the segments in " << folder_ << " from which it is made"
            << " anew begin at " << begin << " s: the averages before would be"
            << " lost. Expected the segments of the whole flow there; move the"
            << " file elsewhere to do without them" << exit(FatalError);
    }
}


void Foam::averageSegments::close(const scalar end)
{
    sums_.end = end;
    sumOnMaster(sums_.volume);
    sumOnMaster(sums_.components);
    reduce(sums_.slurry, sumOp<scalar>());
    if (Pstream::master())
    {
        char name[64];
        std::snprintf(
            name, sizeof(name), "%017.9f_%017.9f.h5", sums_.begin, sums_.end);
        stopWith(untrapped(
            [&] { write_segment((folder_ / name).c_str(), grid_, sums_); }));
    }
    sums_ = SlurrySegment(grid_.size(), withBalls());
    sums_.begin = end;
}


std::vector<std::filesystem::path> Foam::averageSegments::files() const
{
    std::vector<std::filesystem::path> result;
    for (const fileName& name : readDir(folder_, fileName::FILE))
    {
        if (name.hasExt("h5"))
        {
            result.emplace_back((folder_ / name).c_str());
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::averageSegments::averageSegments(
    const word& name, const Time& time, const dictionary& dict,
    const fluidOnBalls* balls)
: time_(time),
  grid_(readGrid(dict)),
  header_(readHeader(dict, time, balls)),
  folder_(time.globalPath() / "postProcessing" / name / "segments"),
  file_(fileOf(dict, time)),
  sums_(grid_.size(), withBalls()),
  covered_(time.value())
{
    sums_.begin = covered_;
    refuseShared(name, file_, dict, time);
    if (Pstream::master())
    {
        // Before the flow, not after it
        stopWith(untrapped([&] { require_slurry_or_nothing(file_.c_str()); }));
        mkDir(folder_);
        dropLater();
        check();
        keepEarlier();
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::averageSegments::add(
    const VoxelSums& sample, const scalar slurry, const scalar from,
    const scalar to)
{
    scalar begin = from;
    while (begin < to - instant_)
    {
        const scalar segmentEnds = segmentEnd(begin);
        const scalar end = min(to, segmentEnds);
        sums_.add(sample, slurry, end - begin);
        if (segmentEnds <= to + instant_)
        {
            close(segmentEnds);
        }
        begin = end;
    }
    covered_ = to;
}


Foam::string Foam::averageSegments::boxDescription() const
{
    const auto at = [](const Vector3& p) { return vector(p[0], p[1], p[2]); };
    readableText text;
    text << "the box of the voxels, from " << at(grid_.lower()) << " to "
         << at(grid_.upper()) << " m";
    return text.str();
}


void Foam::averageSegments::keep()
{
    if (sums_.samples > 0)
    {
        close(covered_);
    }
}


void Foam::averageSegments::assemble() const
{
    if (Pstream::master())
    {
        bool hasMean = false;
        stopWith(untrapped(
            [&] {
                hasMean =
                    assemble_slurry(file_.c_str(), grid_, header_, files());
            }));
        Info << "Slurry on voxels: " << file_ << endl;
        if (!hasMean)
        {
            WarningInFunction
                << file_ << " has no mean over the run: no segment begins at"
                << " start, " << scalar(header_.start) << " s, or later"
                << endl;
        }
    }
}


// ************************************************************************* //
