/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurrySurface.H"
#include "contactAngles.H"
#include "fvcGrad.H"
#include "knownEntries.H"
#include "unitConversion.H"
#include "zeroFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace
{

//- Weight of the normal before, relative to the area of the surface in the
//  neighbours over V^(2/3). It counts where they leave a normal free. With 1e-6
//  a trace of slurry in a neighbour turned the plane of a cell: layers of the
//  12 cm mill that were alike parted 30 to 60 times faster
constexpr scalar held = 1e-2;

//- Slurry or air below this share makes a cell's level less trusted
constexpr scalar traceShare = 0.02;

} // End anonymous namespace
} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::slurrySurface::place(const label celli)
{
    const vector& n = normal()[celli];
    const planeCut::placement placed(
        cut_.place(celli, n, alpha_[celli], n & pieces_.centre[celli]));
    offset_[celli] = placed.level + (n & mesh_.cellCentres()[celli]);
    pieces_.centre[celli] = placed.cut.centre;
    pieces_.area[celli] = placed.cut.area;
}


void Foam::slurrySurface::guessNormals()
{
    const volVectorField gradient(fvc::grad(alpha_));
    const scalarField& volume = mesh_.V();

    forAll(volume, celli)
    {
        pieces_.remove(celli);
        if (alpha_[celli] <= trace || alpha_[celli] >= 1 - trace)
        {
            continue;
        }
        const vector outward(-cbrt(volume[celli]) * gradient[celli]);
        pieces_.normal[celli] = mag(outward) > 1e-6
                                    ? outward / mag(outward)
                                    : (mag(up_) > 0 ? up_ : vector(1, 0, 0));
        place(celli);
    }
    pieces_.correctBoundaryConditions();
}


void Foam::slurrySurface::fitNormals()
{
    symmTensorField ways(mesh_.nCells(), Zero);
    pieces_.forNeighbours(
        [&ways](const label celli, const surfacePieces::neighbour& other)
        {
            ways[celli] +=
                other.area * sqr(other.way) / max(magSqr(other.way), VSMALL);
        });

    const Vector<label>& solved = mesh_.geometricD();
    const scalarField& volume = mesh_.V();
    forAll(normal(), celli)
    {
        if (!pieces_.isCut(celli))
        {
            continue;
        }
        // n & way = 0 for the neighbours, by least squares around the guess: an
        // eigenvector would turn round where two directions are equally flat
        symmTensor m(ways[celli] / cbrt(sqr(volume[celli])) + held * I);
        for (direction i = 0; i < 3; ++i)
        {
            if (solved[i] < 0)
            {
                vector e(Zero);
                e[i] = 1;
                m += sqr(e);
            }
        }
        // Twice: large neighbours leave nothing of the guess then
        const symmTensor inverse(inv(m));
        const vector n(inverse & (inverse & normal()[celli]));
        pieces_.normal[celli] = n / mag(n);
    }
}


void Foam::slurrySurface::placeAll()
{
    forAll(normal(), celli)
    {
        if (pieces_.isCut(celli))
        {
            place(celli);
        }
    }
    pieces_.correctBoundaryConditions();
}


void Foam::slurrySurface::findLevels()
{
    forAll(normal(), celli)
    {
        levelNormal_[celli] = normal()[celli];
        levelOffset_[celli] = offset_[celli];
        levelShare_[celli] = 0;
        const scalar cosine = normal()[celli] & up_;
        if (!pieces_.isCut(celli) || mag(cosine) <= surfaceCosine_)
        {
            continue;
        }
        const scalar share = min(
            (mag(cosine) - surfaceCosine_) / (levelCosine_ - surfaceCosine_),
            scalar(1));
        levelShare_[celli] = cosine > 0 ? share : 0;
        const vector n(
            share * sign(cosine) * up_ + (1 - share) * normal()[celli]);
        levelNormal_[celli] = n / mag(n);
        levelOffset_[celli] = cut_.offset(
            celli, levelNormal_[celli], alpha_[celli],
            levelNormal_[celli] &
                (mesh_.cellCentres()[celli] + pieces_.centre[celli]));
    }
    levelNormal_.correctBoundaryConditions();
}


void Foam::slurrySurface::readControls()
{
    const dictionary& dict =
        mesh_.solutionDict().subOrEmptyDict("slurrySurface");
    requireKnownEntries(dict, {"levelAngle", "fits"});
    // Two numbers in brackets are four tokens
    if (dict.found("levelAngle") && dict.lookup("levelAngle").size() != 4)
    {
        FatalIOErrorInFunction(dict)
            << "levelAngle is " << dict.lookup("levelAngle").toString()
            << "; expected two angles in degrees, as (15 30)"
            << exit(FatalIOError);
    }
    const Pair<scalar> angles(
        dict.lookupOrDefault("levelAngle", Pair<scalar>(15, 30)));
    if (!(angles.first() >= 0 && angles.first() < angles.second() &&
          angles.second() <= 180))
    {
        FatalIOErrorInFunction(dict)
            << "levelAngle is " << angles
            << "; expected two angles in degrees, the smaller first"
            << exit(FatalIOError);
    }
    levelCosine_ = Foam::cos(degToRad(angles.first()));
    surfaceCosine_ = Foam::cos(degToRad(angles.second()));
    fits_ = dict.lookupOrDefault<label>("fits", 2);
    if (fits_ < 0)
    {
        FatalIOErrorInFunction(dict)
            << "fits is " << fits_ << "; expected a number, 0 or above"
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slurrySurface::slurrySurface(const volScalarField& alpha, const vector& g)
: alpha_(alpha),
  mesh_(alpha.mesh()),
  cut_(mesh_),
  up_(mag(g) > VSMALL ? -g / mag(g) : vector::zero),
  levelCosine_(),
  surfaceCosine_(),
  fits_(),
  pieces_(mesh_, contactAngles(alpha)),
  offset_(mesh_.nCells(), Zero),
  levelNormal_(zeroCells<vector>(mesh_, "surface:levelNormal", dimless)),
  levelOffset_(mesh_.nCells(), Zero),
  levelShare_(mesh_.nCells(), Zero),
  depth_(zeroCells<scalar>(mesh_, "surface:depth", dimLength)),
  trust_(zeroCells<scalar>(mesh_, "surface:trust", dimless)),
  wet_(zeroCells<scalar>(mesh_, "wet", dimless)),
  films_(cut_, mesh_, up_),
  crossing_(zeroFaces(mesh_, "surface:crossing", dimless)),
  curvature_()
{
    readControls();
    reconstruct();
    locate();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slurrySurface::findNormals()
{
    guessNormals();
    for (label i = 0; i < fits_; ++i)
    {
        if (i > 0)
        {
            placeAll();
        }
        fitNormals();
    }
}


void Foam::slurrySurface::reconstruct()
{
    findNormals();
    placeAll();
    findLevels();
    curvature_.clear();
}


void Foam::slurrySurface::locate()
{
    const vectorField& centres = mesh_.cellCentres();
    forAll(wet_, celli)
    {
        const scalar alpha = alpha_[celli];
        if (pieces_.isCut(celli))
        {
            depth_[celli] =
                levelOffset_[celli] - (levelNormal_[celli] & centres[celli]);
            trust_[celli] = min(min(alpha, 1 - alpha) / traceShare, scalar(1));
            wet_[celli] = depth_[celli] > 0 ? 1 : 0;
        }
        else
        {
            depth_[celli] = 0;
            trust_[celli] = 0;
            wet_[celli] = alpha > 0.5 ? 1 : 0;
        }
    }
    depth_.correctBoundaryConditions();
    trust_.correctBoundaryConditions();
    wet_.correctBoundaryConditions();
    films_.update({wet_, levelNormal_, depth_, levelShare_});
    findCrossings();
}


// ************************************************************************* //
