/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "IStringStream.H"
#include "sigFpe.H"
#include "smallCase.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Faces, and the cells on their sides, of a lattice of hexahedra
class lattice
{
    const labelVector n_;

    label corner(const label i, const label j, const label k) const
    {
        return i + (n_.x() + 1) * (j + (n_.y() + 1) * k);
    }

    label cell(const labelVector& c) const
    {
        return c.x() + n_.x() * (c.y() + n_.y() * c.z());
    }

    //- The face on the upper side of a cell along an axis, its normal along
    //  the axis; side 0: on the lower
    face
    across(const labelVector& c, const direction axis, const label side) const
    {
        const direction b = (axis + 1) % 3;
        const direction d = (axis + 2) % 3;
        face result(4);
        for (label i = 0; i < 4; ++i)
        {
            labelVector at(c);
            at[axis] += side;
            at[b] += i == 1 || i == 2 ? 1 : 0;
            at[d] += i > 1 ? 1 : 0;
            result[i] = corner(at.x(), at.y(), at.z());
        }
        return side ? result : result.reverseFace();
    }

    template <class Action> void forCells(const Action& action) const
    {
        for (label k = 0; k < n_.z(); ++k)
            for (label j = 0; j < n_.y(); ++j)
                for (label i = 0; i < n_.x(); ++i)
                    action(labelVector(i, j, k));
    }

    public:
    DynamicList<face> faces;
    DynamicList<label> owner;
    DynamicList<label> neighbour;

    explicit lattice(const labelVector& n)
    : n_(n)
    {
    }

    void addInternal()
    {
        forCells(
            [this](const labelVector& c)
            {
                for (direction axis = 0; axis < 3; ++axis)
                {
                    labelVector next(c);
                    next[axis] += 1;
                    if (next[axis] < n_[axis])
                    {
                        faces.append(across(c, axis, 1));
                        owner.append(cell(c));
                        neighbour.append(cell(next));
                    }
                }
            });
    }

    void addSide(const direction axis, const label side)
    {
        forCells(
            [&](const labelVector& c)
            {
                if (c[axis] == (side ? n_[axis] - 1 : 0))
                {
                    faces.append(across(c, axis, side));
                    owner.append(cell(c));
                }
            });
    }
};

pointField pointsOf(const smallBox& box)
{
    DynamicList<point> points;
    const vector cells(box.cells.x(), box.cells.y(), box.cells.z());
    for (label k = 0; k <= box.cells.z(); ++k)
        for (label j = 0; j <= box.cells.y(); ++j)
            for (label i = 0; i <= box.cells.x(); ++i)
                points.append(box.map(cmptDivide(
                    cmptMultiply(vector(i, j, k), box.size), cells)));
    return pointField(points);
}

} // End anonymous namespace
} // End namespace Foam

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::smallCase::makeMesh(const smallBox& box)
{
    lattice cells(box.cells);
    cells.addInternal();
    const char* names[] = {"left", "right", "bottom", "top", "back", "front"};
    labelList starts;
    for (label patchi = 0; patchi < 6; ++patchi)
    {
        starts.append(cells.faces.size());
        cells.addSide(patchi / 2, patchi % 2);
    }
    starts.append(cells.faces.size());

    mesh_.reset(new fvMesh(
        IOobject(
            fvMesh::defaultRegion, time_->timeName(), time_(),
            // Of fvSchemes and fvSolution
            IOobject::READ_IF_PRESENT),
        pointsOf(box), faceList(cells.faces), labelList(cells.owner),
        labelList(cells.neighbour)));
    List<polyPatch*> patches(6);
    for (label patchi = 0; patchi < 6; ++patchi)
    {
        const bool cyclic = box.cyclic && patchi < 2;
        dictionary dict;
        dict.add("type", cyclic ? "cyclic" : patchi < 4 ? "wall" : box.ends);
        dict.add("nFaces", starts[patchi + 1] - starts[patchi]);
        dict.add("startFace", starts[patchi]);
        if (cyclic)
        {
            dict.add("neighbourPatch", word(names[1 - patchi]));
        }
        patches[patchi] =
            polyPatch::New(names[patchi], dict, patchi, mesh_->boundaryMesh())
                .ptr();
    }
    mesh_->addFvPatches(patches);
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::smallCase::smallCase(
    const smallBox& box, const scalar deltaT, const string& solution)
{
    sigFpe::set();

    write(
        "system/fvSchemes",
        "ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }"
        "divSchemes { default Gauss linear; }"
        "laplacianSchemes { default Gauss linear corrected; }"
        "interpolationSchemes { default linear; }"
        "snGradSchemes { default corrected; }");
    write("system/fvSolution", solution);

    dictionary control;
    control.add("startTime", 0);
    control.add("endTime", 1000 * deltaT);
    control.add("deltaT", deltaT);
    control.add("writeInterval", 1000000);
    control.add("writeFormat", word("ascii"));
    control.add("writePrecision", 16);
    control.add("runTimeModifiable", word("no"));
    time_.reset(new Time(
        control, folder_.path.parent_path().string(),
        folder_.path.filename().string()));
    makeMesh(box);
}

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::smallCase::write(
    const std::string& name, const std::string& entries,
    const std::string& type) const
{
    const std::filesystem::path path = folder_.path / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << "FoamFile { version 2.0; format ascii; class "
                        << type << "; object " << path.filename().string()
                        << "; }\n"
                        << entries << '\n';
}

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::point Foam::skewed(const point& p)
{
    const scalar angle = 0.4;
    const scalar x = p.x() + 0.35 * p.y();
    return {
        std::cos(angle) * x - std::sin(angle) * p.y(),
        std::sin(angle) * x + std::cos(angle) * p.y(), p.z() + 0.2 * p.x()};
}

Foam::dictionary Foam::entriesOf(const string& text)
{
    return dictionary(IStringStream(text)());
}

std::string Foam::errorOf(const std::function<void()>& action)
{
    const bool thrown = FatalError.throwExceptions();
    const bool thrownIO = FatalIOError.throwExceptions();
    std::string message;
    try
    {
        action();
    }
    catch (const error& found)
    {
        message = found.message();
    }
    FatalError.throwExceptions(thrown);
    FatalIOError.throwExceptions(thrownIO);
    return message;
}

// ************************************************************************* //
