/*---------------------------------------------------------------------------*\
    millFoam: slurry flow in tumbling mills
    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slurryFlow.H"
#include "calculatedFvPatchFields.H"
#include "coupledPatches.H"
#include "flowState.H"
#include "fvcFlux.H"
#include "fvcSurfaceIntegrate.H"
#include "mathematicalConstants.H"
#include "mixtureFluids.H"
#include "slurryShare.H"
#include "staticFvMesh.H"
#include "optionalDictionary.H"
#include "zeroFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Surface tension, N/m, out of transportProperties
static dimensionedScalar surfaceTension(const dictionary& dict)
{
    dimensionedScalar sigma("sigma", dimForce / dimLength, dict);
    if (!(sigma.value() >= 0))
    {
        FatalIOErrorInFunction(dict)
            << "sigma is " << sigma.value()
            << " N/m; expected a surface tension of 0 or above"
            << exit(FatalIOError);
    }
    return sigma;
}

//- Cells are judged by their volume up to this ratio of it to the cube of their
//  shortest distance. Beyond, half of what is stable by the volume would be more
//  than what is stable by this distance
static constexpr scalar flat_ = 4;


//- Distance of each cell to the nearest of its neighbours, m: to their middles,
//  and twice to a patch. GREAT without neighbours
static scalarField shortestDistances(const fvMesh& mesh)
{
    const surfaceScalarField& inverse = mesh.nonOrthDeltaCoeffs();
    scalarField result(mesh.nCells(), GREAT);
    const auto limit = [&result](const label celli, const scalar distance)
    { result[celli] = min(result[celli], distance); };
    forAll(mesh.neighbour(), facei)
    {
        limit(mesh.owner()[facei], 1 / inverse[facei]);
        limit(mesh.neighbour()[facei], 1 / inverse[facei]);
    }
    forAll(inverse.boundaryField(), patchi)
    {
        const fvsPatchScalarField& patch = inverse.boundaryField()[patchi];
        const scalar times = patch.patch().coupled() ? 1 : 2;
        const labelUList& cells = mesh.boundary()[patchi].faceCells();
        // An empty patch has no values
        forAll(patch, i)
        {
            limit(cells[i], times / patch[i]);
        }
    }
    return result;
}


//- A field of the flow that is written for a restart
static IOobject
fieldIO(const word& name, const fvMesh& mesh, const IOobject::readOption read)
{
    return IOobject(
        name, mesh.time().timeName(), mesh, read, IOobject::AUTO_WRITE);
}


//- Whether a restart has this field
static bool isThere(const word& name, const fvMesh& mesh)
{
    return fieldIO(name, mesh, IOobject::READ_IF_PRESENT)
        .typeHeaderOk<volVectorField>(true);
}


//- A field that a restart resumes, or zero
template <class FieldType>
static FieldType
continued(const word& name, const fvMesh& mesh, const dimensionSet& dimensions)
{
    return FieldType(
        fieldIO(name, mesh, IOobject::READ_IF_PRESENT), mesh,
        dimensioned<typename FieldType::value_type>("zero", dimensions, Zero));
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::slurryFlow::keepState()
{
    voidageChange_ = gMax(mag(
        voidage_.primitiveField() / voidage_.oldTime().primitiveField() - 1)());
    withoutRoom_ += solution_.withoutRoom();
    closed_.add(phi_, voidage_);
    state_.set("voidageChange", voidageChange_);
    state_.set("withoutRoom", withoutRoom_);
    state_.set("surplus", closed_.surplus());
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slurryFlow::slurryFlow(
    dynamicFvMesh& mesh, millfoam::record::StageClock& clock)
: mesh_(mesh),
  clock_(clock),
  bedDict_(optionalDictionary("bedProperties", mesh)),
  g_(IOobject(
      "g", mesh.time().constant(), mesh, IOobject::MUST_READ,
      IOobject::NO_WRITE)),
  hRef_(
      IOobject("hRef", mesh.time().constant(), mesh),
      dimensionedScalar(dimLength, Zero)),
  voidageRate_(bedDict_.lookupOrDefault<Switch>("voidageRate", true)),
  bed_(bedDict_, mesh),
  U_(fieldIO("U", mesh, IOobject::MUST_READ), mesh),
  phi_(
      fieldIO("phi", mesh, IOobject::READ_IF_PRESENT),
      fvc::flux(bed_.voidage() * evaluateCoupled(U_))),
  mixture_(U_, phi_),
  alpha_(checkedShare(mixture_.alpha1())),
  rho_("rho", alpha_ * mixture_.rho1() + (1.0 - alpha_) * mixture_.rho2()),
  voidage_(
      IOobject("flowVoidage", mesh.time().timeName(), mesh), bed_.voidage()),
  swept_(voidage_, bed_.inSpace() && !isA<staticFvMesh>(mesh)),
  contraction_(bed_, voidage_, U_),
  p_rgh_(fieldIO("p_rgh", mesh, IOobject::MUST_READ), mesh),
  // The conditions of p_rgh would keep its values at patches
  p_(fieldIO("p", mesh, IOobject::NO_READ), evaluateCoupled(p_rgh_),
     wordList(mesh.boundary().size(), calculatedFvPatchScalarField::typeName)),
  surface_(alpha_, g_.value()),
  pressure_(
      surface_, p_rgh_, g_, mixture_.rho1(), mixture_.rho2(),
      surfaceTension(mixture_)),
  solution_(p_rgh_, pressure_, !isThere("forceAcceleration", mesh), clock),
  transport_(surface_, alpha_),
  grates_(
      IOdictionary(optionalDictionary("grateProperties", mesh)), mesh,
      fluidsOf(mixture_)),
  forces_(
      continued<volVectorField>("forceAcceleration", mesh, dimAcceleration)),
  turning_(U_, g_.value()),
  carryingForce_(),
  projectedDensity_(
      IOobject("projectedDensity", mesh.time().timeName(), mesh),
      rho_.internalField()),
  contractionFlux_(zeroFaces(mesh, "contractionFlux", dimVolume / dimTime)),
  fluxDetail_(
      continued<surfaceScalarField>("fluxDetail", mesh, dimVolume / dimTime)),
  detailBefore_("fluxDetailBefore", fluxDetail_),
  massMoved_(continued<surfaceScalarField>("massMoved", mesh, dimMass)),
  slurryFlux_(
      IOobject(
          IOobject::groupName("alphaPhi", mixture_.phase1Name()),
          mesh.time().timeName(), mesh),
      mesh, dimensionedScalar(dimVolume / dimTime, Zero)),
  turbulence_(incompressible::turbulenceModel::New(U_, phi_, mixture_)),
  newtonianStress_(turbulence_->type() == "Stokes"),
  fvOptions_(fv::options::New(mesh)),
  state_(IOobject(
      "slurryFlow", mesh.time().timeName(), "uniform", mesh,
      IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE)),
  // Versions before 0.3.0 wrote it as misfit, with the other sign
  withoutRoom_(state_.lookupOrDefault<scalar>(
      "withoutRoom", -state_.lookupOrDefault<scalar>("misfit", 0))),
  closed_(p_rgh_, U_, voidage_, state_.lookupOrDefault<scalar>("surplus", 0)),
  voidageChange_(state_.lookupOrDefault<scalar>("voidageChange", 0)),
  told_(bed_.feelsFlow() ? new toldForces(mesh) : nullptr)
{
    requireState(
        {"phi", "forceAcceleration", "fluxDetail", "massMoved", "slurryFlow"},
        mesh);
    // A flow whose balls did not feel it has told them nothing
    if (told_.valid() && state_.lookupOrDefault("told", false))
    {
        requireState({"toldPressure", "toldExchange", "toldForces"}, mesh);
    }
    state_.set("told", told_.valid());
    contractionFlux_.setOriented();
    fluxDetail_.setOriented();
    massMoved_.setOriented();
    slurryFlux_.setOriented();
    evaluateCoupled(forces_);
    mixture_.correct();
    turbulence_->validate();
    voidage_.oldTime();
    pressure_.update(p_rgh_, rho_);
    p_ = pressure_.staticPressure();

    readBed();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::courantNumbers Foam::slurryFlow::bounds() const
{
    const scalar deltaT = mesh_.time().deltaTValue();
    const scalarField passed(
        0.5 * deltaT * fvc::surfaceSum(mag(phi_))().primitiveField() /
        (mesh_.V() * voidage_.primitiveField()));

    const scalarField shortest(shortestDistances(mesh_));
    scalar smallest = GREAT;
    courantNumbers result;
    forAll(passed, celli)
    {
        scalar& largest = alpha_[celli] > 0.01 ? result.flow : result.air;
        largest = max(largest, passed[celli]);
        if (alpha_[celli] > 0.01 && alpha_[celli] < 0.99)
        {
            result.surface = max(result.surface, passed[celli]);
            smallest = min(
                smallest, min(mesh_.V()[celli], flat_ * pow3(shortest[celli])));
        }
    }
    reduce(result.flow, maxOp<scalar>());
    reduce(result.surface, maxOp<scalar>());
    reduce(result.air, maxOp<scalar>());
    reduce(smallest, minOp<scalar>());
    result.voidageChange = voidageChange_;
    const scalar capillary = 4 * constant::mathematical::pi *
                             pressure_.surfaceTension().value() /
                             (mixture_.rho1() + mixture_.rho2()).value();
    result.capillary = deltaT * sqrt(capillary / smallest);
    return result;
}


millfoam::record::StepRow Foam::slurryFlow::report()
{
    millfoam::record::StepRow row;
    const scalarField fluid(mesh_.V() * voidage_.primitiveField());
    row.time = mesh_.time().value();
    row.delta_t = mesh_.time().deltaTValue();
    row.pressure_iterations = solution_.iterations();
    row.pressure_residual = solution_.residual();
    row.slurry = gSum(fluid * alpha_.primitiveField());
    row.fluid = gSum(fluid);
    row.alpha_min = gMin(alpha_.primitiveField());
    row.alpha_above = gMax(alpha_.primitiveField()) - 1;
    row.without_room = withoutRoom_;
    Info << "Slurry " << row.slurry << " m3, fluid " << row.fluid
         << " m3, alpha from " << row.alpha_min << " to " << 1 << " + "
         << row.alpha_above << ", fluid without room " << row.without_room
         << " m3" << endl;
    bed_.addTo(row);
    if (drag_.valid())
    {
        drag_->report(bed_, alpha_, U_);
        drag_->addTo(row);
    }
    if (continuity_.valid())
    {
        Info << "bed: " << continuity_->description().c_str() << endl;
        row.continuity_residual = continuity_->residual();
        row.continuity_speed = continuity_->driven();
        row.slip = continuity_->slip();
    }
    if (load_.valid() && mesh_.time().writeTime())
    {
        load_->update(
            pressureForce(), drag_->exchange(bed_, alpha_.oldTime(), U_), U_);
        Info << "bed: " << load_->description().c_str() << endl;
        row.force_mean = load_->mean();
        row.force_95 = load_->high();
    }
    if (told_.valid())
    {
        const vector& force = told_->force();
        row.given_force = {force.x(), force.y(), force.z()};
        row.given_torque = told_->torque();
    }
    return row;
}


void Foam::slurryFlow::addTo(millfoam::record::FlowSetup& setup) const
{
    if (!bed_.empty())
    {
        setup.solids = bed_.forRecord();
    }
    if (drag_.valid())
    {
        setup.drag = drag_->forRecord();
    }
}


void Foam::slurryFlow::summary() const
{
    if (drag_.valid())
    {
        drag_->summary();
    }
    if (load_.valid())
    {
        Info << "bed: " << load_->summary().c_str() << endl;
    }
}


// ************************************************************************* //
