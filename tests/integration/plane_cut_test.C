/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later

Application
    plane_cut_test

Description
    planeCut on the mesh of a box whose inner points are shaken, against what
    is known of the box as a whole; exit code 1 when anything differs.

    A plane that leaves the box by its four upright sides has below it the
    volume A h, h being its height over the middle of the floor A; its cut has
    the area A/n_y, and its centre is the plane's point over the middle. The
    cells' parts must add up to that, whatever their shapes.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "boundBox.H"
#include "fvMesh.H"
#include "planeCut.H"
#include "Random.H"

#include <cmath>

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

//- Shake all points but those of the boundary by a quarter of a cell
static void shake(fvMesh& mesh)
{
    boolList fixed(mesh.nPoints(), false);
    for (label facei = mesh.nInternalFaces(); facei < mesh.nFaces(); ++facei)
    {
        UIndirectList<bool>(fixed, mesh.faces()[facei]) = true;
    }
    const scalar reach = 0.25 * std::cbrt(min(mesh.cellVolumes()));
    Random random(2026);
    pointField points(mesh.points());
    forAll(points, pointi)
    {
        const vector by(random.position(-vector::one, vector::one));
        if (!fixed[pointi])
        {
            points[pointi] += reach * by;
        }
    }
    mesh.movePoints(points);
}


//- Counts a difference above the tolerance, and prints it
static label differs(
    const char* what, const scalar found, const scalar expected,
    const scalar tolerance)
{
    if (mag(found - expected) <= tolerance)
    {
        return 0;
    }
    Info << what << ": " << found << " instead of " << expected << endl;
    return 1;
}


//- All cells' parts below a plane through p, n_y > 0
static label compareSums(const fvMesh& mesh, const vector& n, const point& p)
{
    const planeCut cut(mesh);
    const boundBox box(mesh.points(), false);
    const scalar d = n & p;
    scalar volume = 0, area = 0;
    vector moment(Zero);
    forAll(mesh.cells(), celli)
    {
        volume += cut.wetVolume(celli, n, d);
        const planeCut::section section = cut.cut(celli, n, d);
        area += section.area;
        moment += section.area * section.centre;
    }
    const vector size(box.span());
    const scalar floor = size.x() * size.z();
    const point middle(box.midpoint());
    const scalar height = (d - n.x() * middle.x() - n.z() * middle.z()) / n.y();
    const point above(middle.x(), height, middle.z());
    return differs(
               "volume", volume, floor * (height - box.min().y()),
               1e-13 * floor * size.y()) +
           differs("area", area, floor / n.y(), 1e-12 * floor) +
           differs(
               "centre of the cut", mag(moment / area - above), 0,
               1e-12 * mag(size));
}


//- Offsets that leave given shares, cell by cell, and the ends
static label compareOffsets(const fvMesh& mesh, const vector& n)
{
    const planeCut cut(mesh);
    label wrong = 0;
    forAll(mesh.cells(), celli)
    {
        for (const scalar share : {1e-9, 0.003, 0.25, 0.5, 0.9, 1 - 1e-6})
        {
            const scalar d = cut.offset(celli, n, share);
            const scalar centre = n & mesh.cellCentres()[celli];
            for (const scalar guess :
                 {scalar(GREAT), centre, d, 2 * centre - d})
            {
                const scalar found = cut.offset(celli, n, share, guess);
                wrong += differs(
                    "share below the offset",
                    cut.wetVolume(celli, n, found) / mesh.cellVolumes()[celli],
                    share, 1e-12);
            }
        }
    }
    return wrong;
}


//- Faces that a plane passes: one upright plane over the floor's rectangles,
//  and two halves of a time against the whole for all
static label compareFaces(const fvMesh& mesh, const vector& n)
{
    const planeCut cut(mesh);
    label wrong = 0;
    for (const label facei : mesh.boundaryMesh()["bottom"].range())
    {
        const boundBox face(mesh.faces()[facei].points(mesh.points()), false);
        const scalar x = face.min().x() + 0.3 * face.span().x();
        const vector e(1, 0, 0);
        wrong += differs("at rest", cut.wetShare(facei, e, x, x), 0.3, 1e-12);
        // From outside, to the place where 0.3 are wet: the mean of a ramp
        const scalar begin = face.min().x() - 0.2 * face.span().x();
        wrong += differs(
            "passing", cut.wetShare(facei, e, begin, x), 0.045 / 0.5, 1e-12);
    }
    forAll(mesh.faces(), facei)
    {
        const scalar d = n & mesh.faceCentres()[facei];
        const scalar reach = 0.4 * std::sqrt(mag(mesh.faceAreas()[facei]));
        const scalar whole = cut.wetShare(facei, n, d - reach, d + reach);
        const scalar halves = (cut.wetShare(facei, n, d - reach, d) +
                               cut.wetShare(facei, n, d, d + reach)) /
                              2;
        wrong += differs("in halves", halves, whole, 1e-12);
        wrong += differs(
            "the other way", cut.wetShare(facei, n, d + reach, d - reach),
            whole, 1e-12);
    }
    return wrong;
}


int main(int argc, char* argv[])
{
#include "setRootCase.H"
#include "createTime.H"
    fvMesh mesh(IOobject(
        fvMesh::defaultRegion, runTime.timeName(), runTime,
        IOobject::MUST_READ));
    shake(mesh);

    const point middle(boundBox(mesh.points(), false).midpoint());
    label wrong = 0;
    for (const vector& slope :
         {vector(0, 1, 0), vector(0.2, 1, 0), vector(-0.13, 1, 0.31)})
    {
        const vector n(slope / mag(slope));
        for (const scalar up : {0., 0.0013, -0.0021})
        {
            wrong += compareSums(mesh, n, middle + vector(0, up, 0));
        }
        wrong += compareOffsets(mesh, n) + compareFaces(mesh, n);
    }
    Info << (wrong ? "FAILED: " : "passed: ") << wrong << " differences"
         << endl;
    return wrong ? 1 : 0;
}


// ************************************************************************* //
