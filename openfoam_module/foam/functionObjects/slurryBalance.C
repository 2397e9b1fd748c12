/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryBalance.H"
#include "addToRunTimeSelectionTable.H"
#include "clock.H"
#include "fixedValueFvPatchFields.H"
#include "fluidOnBalls.H"
#include "mixtureFluids.H"
#include "weightedSpread.H"
#include "openfoam_module/drag/drag_laws.hpp"
#include "openfoam_module/drag/pore_shear_rate.hpp"
#include "openfoam_module/record/rotation.hpp"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(slurryBalance, 0);
addToRunTimeSelectionTable(functionObject, slurryBalance, dictionary);
} // End namespace functionObjects
} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::functionObjects::slurryBalance::begin()
{
    writeHeader(file(), "Slurry: balance, centre, torque about +z, slip");
    writeHeaderValue(file(), "Begun", label(clock::getTime()));
    writeHeaderValue(file(), "Speed_rad/s", torque_.speed());
    writeHeaderValue(
        file(), "Mill",
        millfoam::record::described_rotation(torque_.speed()).c_str());
    writeCommented(file(), "Time_s");
    for (const char* column :
         {"holdUp_m3", "feed_m3/s", "discharge_m3/s", "fed_m3", "discharged_m3",
          "missing_m3", "x_m", "y_m", "z_m"})
    {
        writeTabbed(file(), column);
    }
    for (const word& patch : torque_.names())
    {
        writeTabbed(file(), "torque_" + patch + "_Nm");
    }
    if (torque_.knowsBalls())
    {
        writeTabbed(file(), "torque_balls_Nm");
    }
    writeTabbed(file(), "torque_all_Nm");
    for (const word& patch : torque_.names())
    {
        writeTabbed(file(), "power_" + patch + "_W");
    }
    writeTabbed(file(), "power_W");
    if (force_.known())
    {
        writeNames("balance");
    }
    if (force_.knowsFelt())
    {
        writeNames("balls");
    }
    if (fields_.bed<volScalarField>("solidity"))
    {
        for (const char* column : {"Re_mean", "Re_95", "slip_max_m/s"})
        {
            writeTabbed(file(), column);
        }
    }
    file() << endl;
}


Foam::vector Foam::functionObjects::slurryBalance::centre() const
{
    const scalarField volumes(fields_.volumes());
    return gSum((volumes * mesh_.C().primitiveField())()) /
           max(gSum(volumes), VSMALL);
}


void Foam::functionObjects::slurryBalance::writeNames(const word& force)
{
    for (const char* axis : {"x", "y", "z"})
    {
        writeTabbed(file(), "force_" + force + "_" + axis + "_N");
    }
}


void Foam::functionObjects::slurryBalance::writeVector(const vector& value)
{
    file() << tab << value.x() << tab << value.y() << tab << value.z();
}


void Foam::functionObjects::slurryBalance::writeSlip()
{
    const scalarField& solidity =
        fields_.bed<volScalarField>("solidity")->primitiveField();
    const volVectorField* balls = fields_.bed<volVectorField>("solidsVelocity");
    const volScalarField* diameter =
        fields_.bed<volScalarField>("solidsDiameter");
    const bedFluids fluids =
        fluidsOf(mesh_.lookupObject<incompressibleTwoPhaseMixture>(
            "transportProperties"));
    const scalarField slip(
        mag(balls->primitiveField() - fields_.U().primitiveField()));
    const auto* flow = mesh_.findObject<fluidOnBalls>(fluidOnBalls::typeName);
    const slurryViscosity viscosity(
        flow ? flow->flow().viscosity
             : slurryViscosity(dictionary::null, fluids.slurry));
    scalarField reynolds(slip.size());
    forAll(reynolds, celli)
    {
        const scalar phi = solidity[celli];
        const scalar d = (*diameter)[celli];
        const scalar rate =
            d > 0 ? millfoam::drag::pore_shear_rate(phi, slip[celli], d) : 0;
        reynolds[celli] = millfoam::drag::reynolds(
            phi, slip[celli], d, {fluids.slurryDensity, viscosity.at(rate)});
    }
    const scalarField weights(
        solidity * mesh_.V() * pos(fields_.alpha().primitiveField() - 0.5));

    const weightedSpread spread = spreadOf(reynolds, weights);
    const weightedSpread slips = spreadOf(slip, weights);
    file() << tab << spread.mean << tab << spread.high << tab << slips.largest;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::slurryBalance::slurryBalance(
    const word& name, const Time& runTime, const dictionary& dict)
: fvMeshFunctionObject(name, runTime, dict),
  writeFile(mesh_, name, typeName, dict),
  fields_(mesh_, dict),
  torque_(fields_, dict),
  force_(fields_, torque_),
  holdUp_(gSum(fields_.volumes()())),
  feed_(0),
  discharge_(0),
  firstHoldUp_(getProperty<scalar>("firstHoldUp", scalar(holdUp_))),
  fed_(getProperty<scalar>("fed")),
  discharged_(getProperty<scalar>("discharged")),
  momentum_(torque_.momentum()),
  torqueAll_(0)
{
    slurryFields::refuseOthers(dict, {"walls", "resting", "speed"});
    fields_.requireWholeFlux();
    if (runTime.timeIndex() > 0 && !foundProperty("fed"))
    {
        WarningInFunction << "time " << runTime.timeName()
                          << " was written without a balance"
                          << ": the integrals begin here" << endl;
    }
    begin();
    strict_.relax();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::slurryBalance::execute()
{
    holdUp_ = gSum(fields_.volumes()());
    feed_ = 0;
    discharge_ = 0;
    forAll(mesh_.boundary(), patchi)
    {
        if (!mesh_.boundary()[patchi].coupled())
        {
            const scalar out = gSum(fields_.flux().boundaryField()[patchi]);
            // fixesValue() holds for inletOutlet, too
            if (isA<fixedValueFvPatchScalarField>(
                    fields_.alpha().boundaryField()[patchi]))
            {
                feed_ -= out;
            }
            else
            {
                discharge_ += out;
            }
        }
    }

    const scalar deltaT = mesh_.time().deltaTValue();
    fed_ += deltaT * feed_;
    discharged_ += deltaT * discharge_;
    const scalar momentum = torque_.momentum();
    torqueAll_ = (momentum - momentum_) / deltaT + torque_.drain();
    momentum_ = momentum;
    force_.update();

    setProperty("firstHoldUp", firstHoldUp_);
    setProperty("fed", fed_);
    setProperty("discharged", discharged_);
    return true;
}


bool Foam::functionObjects::slurryBalance::write()
{
    const vector middle(centre());
    const scalarField walls(torque_.ofWalls());
    const scalar missing = holdUp_ - firstHoldUp_ - fed_ + discharged_;

    writeCurrentTime(file());
    for (const scalar value :
         {holdUp_, feed_, discharge_, fed_, discharged_, missing, middle.x(),
          middle.y(), middle.z()})
    {
        file() << tab << value;
    }
    for (const scalar value : walls)
    {
        file() << tab << value;
    }
    if (torque_.knowsBalls())
    {
        file() << tab << torque_.ofBalls();
    }
    file() << tab << torqueAll_;
    for (const scalar value : torque_.powers(walls))
    {
        file() << tab << value;
    }
    file() << tab << torque_.power(torqueAll_, walls);
    if (force_.known())
    {
        writeVector(force_.byBalance());
    }
    if (force_.knowsFelt())
    {
        writeVector(force_.felt());
    }
    if (fields_.bed<volScalarField>("solidity"))
    {
        writeSlip();
    }
    file() << endl;
    return true;
}


// ************************************************************************* //
