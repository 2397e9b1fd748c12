# SPDX-License-Identifier: GPL-3.0-or-later
"""A column of balls and water, one stack of cells: both at the same time, or in turn.

LIGGGHTS runs as in a mill, by the program millLiggghts. Its deck and what it must know of the flow (fluid.json,
FORMATS.md) are written here, because a column is no mill. The balls are periodic to the sides and lie on a floor of
two triangles, whose force is recorded."""
import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from millfoam.coupling.ball_forces import relaxed, write_ball_forces
from millfoam.files.constants import GRAVITY
from millfoam.coupling.together import run_together
from millfoam.files import foam
from millfoam.files.slurry_file import read_ball_forces
from millfoam.run import run as run_program
from millfoam.run import copy_case, write_parameters

HERE = Path(__file__).parent.resolve()
RESOURCES = HERE.parent / "resources"
WATER, VISCOSITY = 1000.0, 1e-3  # kg/m3, Pa s
BALL = 2700.0  # kg/m3
TIMESTEP = 2e-5  # s, of the balls: 0.16 of the Rayleigh time of 2 mm at 5e6 Pa
RELAXATION = 0.7  # of the forces from pass to pass, as a mill's flow.relaxation
RECORD = 50  # steps, 1 ms
CONTACTS = "gran model hertz tangential history rolling_friction cdt"
PROPERTIES = {"youngsModulus": ("peratomtype", 5e6), "poissonsRatio": ("peratomtype", 0.23),
              "coefficientRollingFriction": ("peratomtypepair 1", 0.01)}


@dataclass
class Column:
    """A column of a square section with balls at some heights, and water that enters below.

    width, height: m; cells: of the flow, also the voxels of the balls' averages if `voxels` is not given; law: of the
    drag; feed: (time s, superficial velocity m/s) …, linear between; end: s; settle: s in which the balls fall dry
    before time 0; largest_step: of the flow, s; write_interval: of its fields, s; averages: s from which on the mean
    fields are taken; periodic: balls that leave at an end come back at the other one, and there is no floor;
    friction, restitution: of two balls, and of a ball and the floor; gravity: m/s2."""
    width: float
    height: float
    cells: int
    law: str
    end: float
    voxels: int = 0
    feed: tuple[tuple[float, float], ...] = ((0.0, 0.0),)
    settle: float = 0.0
    polydispersity: bool = False
    periodic: bool = False
    friction: float = 0.5
    restitution: float = 0.5
    gravity: float = GRAVITY
    largest_step: float = 1e-3
    write_interval: float = 0.02
    averages: float = 0.0

    @property
    def area(self):
        return self.width**2

    @property
    def shape(self):
        return (1, 1, self.voxels or self.cells)

    def feed_at(self, time):
        """Superficial velocity at these times, m/s."""
        times, speeds = zip(*self.feed)
        return np.interp(time, times, speeds)


@dataclass
class Balls:
    """Balls at the start: places [n, 3] and diameters [n], m; velocities [n, 3], m/s, None at rest. They do not
    spin."""
    place: np.ndarray
    diameter: np.ndarray
    velocity: np.ndarray | None = None

    @property
    def volume(self):
        """Of all balls, m3."""
        return (np.pi / 6 * self.diameter**3).sum()

    @property
    def buoyant_weight(self):
        """Of all balls, N."""
        return (BALL - WATER) * GRAVITY * self.volume


def scattered(column, solidity, bottom, top, diameters, seed=1):
    """Balls of a mean solidity between two heights (m): on a cubic lattice, moved as far at random as they do not
    touch. diameters (m) are dealt in turn, in random order."""
    random = np.random.default_rng(seed)
    volume = np.mean(np.pi / 6 * np.array(diameters)**3)
    across = max(1, int(round(column.width / (volume / solidity)**(1 / 3))))
    layers = int(round(solidity * column.area * (top - bottom) / (volume * across**2)))
    spacing = np.array([column.width / across, column.width / across, (top - bottom) / layers])
    room = spacing - max(diameters)
    if np.any(room < 0):
        raise ValueError(f"balls of {max(diameters)} m at solidity {solidity} have {spacing} m each; "
                         "expected more than a diameter")
    index = np.stack(np.meshgrid(*(np.arange(count) for count in (across, across, layers)), indexing="ij"), -1)
    place = (index.reshape(-1, 3) + 0.5) * spacing
    place += (random.random(place.shape) - 0.5) * room
    place[:, 2] += bottom
    dealt = np.resize(diameters, len(place))
    random.shuffle(dealt)
    return Balls(place, dealt)


@dataclass
class Motion:
    """What LIGGGHTS wrote of a run: time [t], s; place and velocity [t, n, 3] of the balls, in the order of their
    numbers; floor [t]: force of the balls on the floor, downwards, N; fluid [t]: force of the fluid on all balls,
    upwards, N. floor and fluid are means over the steps of the record before their time."""
    time: np.ndarray
    place: np.ndarray
    velocity: np.ndarray
    floor: np.ndarray
    fluid: np.ndarray


@dataclass
class Fields:
    """What slurryFoam wrote: time [t], s; height [c] of the cells' centres, m; at each time and cell the solidity and
    the upward velocities of the water, interstitial, and of the balls, m/s; drop [t]: p_rgh at the floor, Pa; at the
    top it is 0."""
    time: np.ndarray
    height: np.ndarray
    solidity: np.ndarray
    u: np.ndarray
    balls: np.ndarray
    drop: np.ndarray

    @property
    def cell(self):
        """Height of a cell, m."""
        return self.height[1] - self.height[0]


def write_balls(path, column, balls):
    rows = "\n".join(f"{number} 1 {diameter:.17g} {BALL:g} {x:.17g} {y:.17g} {z:.17g}" for number, ((x, y, z), diameter)
                     in enumerate(zip(balls.place, balls.diameter), start=1))
    velocity = np.zeros_like(balls.place) if balls.velocity is None else balls.velocity
    speeds = "\n".join(f"{number} {u:.17g} {v:.17g} {w:.17g} 0 0 0" for number, (u, v, w) in enumerate(velocity, 1))
    low = 0 if column.periodic else balls.diameter.max()
    path.write_text(f"balls of a column\n\n{len(balls.place)} atoms\n1 atom types\n\n0 {column.width:.17g} xlo xhi\n"
                    f"0 {column.width:.17g} ylo yhi\n{-low:.17g} {column.height:.17g} zlo zhi\n\n"
                    f"Atoms\n\n{rows}\n\nVelocities\n\n{speeds}\n")


def write_floor(path, width):
    """Two triangles at z = 0."""
    triangles = ((0, 0), (width, 0), (width, width)), ((0, 0), (width, width), (0, width))
    text = "".join("facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {x:.17g} {y:.17g} 0\n" for x, y in corners)
                   + "endloop\nendfacet\n" for corners in triangles)
    path.write_text(f"solid floor\n{text}endsolid floor\n")


def deck(column, balls, fluid):
    """The deck; fluid: whether a fluid acts on the balls from time 0 on."""
    lines = ["units si", "atom_style granular", "atom_modify map array", "newton off", "communicate single vel yes",
             f"boundary p p {'p' if column.periodic else 'f'}",
             "read_data balls.data", f"neighbor {0.4 * balls.diameter.min():g} bin",
             "neigh_modify delay 0"]
    properties = {**PROPERTIES, "coefficientFriction": ("peratomtypepair 1", column.friction),
                  "coefficientRestitution": ("peratomtypepair 1", column.restitution)}
    lines += [f"fix {name} all property/global {name} {kind} {value:g}" for name, (kind, value) in properties.items()]
    lines += [f"pair_style {CONTACTS}", "pair_coeff * *", f"timestep {TIMESTEP:g}",
              f"fix gravity all gravity {column.gravity:g} vector 0 0 -1"]
    if not column.periodic:
        lines += ["fix floor all mesh/surface/stress file floor.stl type 1",
                  f"fix walls all wall/{CONTACTS} mesh n_meshes 1 meshes floor"]
    lines += ["thermo 10000", "fix motion all nve/sphere",
              f"run {round(column.settle / TIMESTEP)}", "reset_timestep 0"]
    if fluid:
        lines.append("fix fluid all external pf/callback 1 1")
    if not column.periodic:
        lines.append(f"fix force all ave/time 1 {RECORD} {RECORD} f_floor[3] file floor.txt")
    lines += [f"dump balls all custom {10 * RECORD} balls.*.txt id type x y z vx vy vz radius",
              'dump_modify balls format "%d %d %.10g %.10g %.10g %.10g %.10g %.10g %.10g"',
              f"run {round(column.end / TIMESTEP)}"]
    return "\n".join(lines) + "\n"


def order(**of_kind):
    """fluid.json."""
    return {"format": "millfoam-fluid", "timestep_s": TIMESTEP, "interval": RECORD, **of_kind}


def exchange_order(column, balls):
    """What millLiggghts must know to meet a flow."""
    return order(kind="flow", folder="exchange", exchange={
        "lower_m": [0, 0, 0], "upper_m": [column.width, column.width, column.height], "shape": column.shape,
        "periodic": [True, True, column.periodic], "exact": True, "template_points": 12, "walls": [],
        "angular_velocity_rad_s": 0, "averages": "", "ball_density_kg_m3": BALL,
        "smallest_ball_m": balls.diameter.min(), "rayleigh_fraction": 0.16, "begin": 0,
        "end": round(column.end / TIMESTEP)})


def file_hash(path):
    """As millDem names a file: FNV-1a, 64 bits, 16 hexadecimal digits."""
    value = 0xcbf29ce484222325
    for byte in path.read_bytes():
        value = (value ^ byte) * 0x100000001b3 % 2**64
    return f"{value:016x}"


def make_case(case, column, balls, entry, source):
    """The flow's case; entry, source: key and value in bedProperties by which it knows its balls."""
    copy_case(case, RESOURCES / "common", RESOURCES / "column", HERE / "template")
    feed = " ".join(f"({time:g} {speed * column.area:.17g})" for time, speed in column.feed)
    write_parameters(case, width=column.width, height=column.height, cells=column.cells, voxels=column.shape[2],
                     law=column.law, polydispersity="yes" if column.polydispersity else "no", feed=feed,
                     gravity=f"(0 0 {-GRAVITY})", slurryDensity=WATER, slurryKinematicViscosity=VISCOSITY / WATER,
                     endTime=column.end, largestStep=column.largest_step, writeInterval=column.write_interval,
                     averagesStart=column.averages,
                     **{entry: f'"{source}"'})
    run_program(case, "blockMesh")
    write_balls(case / "balls.data", column, balls)
    write_floor(case / "floor.stl", column.width)


def run_direct(case, column, balls):
    """Balls and flow at the same time. (Motion, Fields)"""
    make_case(case, column, balls, "exchange", "exchange")
    (case / "in.column").write_text(deck(column, balls, fluid=True))
    (case / "fluid.json").write_text(json.dumps(exchange_order(column, balls)))
    with open(case / "log.slurryFoam", "w") as log:
        run_together(["millLiggghts", "-in", "in.column"], ["slurryFoam"], case, log)
    return read_motion(case), read_fields(case, column)


def run_balls(case, column, balls, forces):
    """Balls alone, that feel the forces of a flow's slurry.h5 (None: none). Motion"""
    case.mkdir()
    write_balls(case / "balls.data", column, balls)
    write_floor(case / "floor.stl", column.width)
    (case / "in.column").write_text(deck(column, balls, fluid=forces is not None))
    if forces is not None:
        (case / "fluid.json").write_text(json.dumps(order(
            kind="slurry", file=str(forces), file_id=file_hash(forces), time="mean")))
    run_program(case, "millLiggghts", "-in", "in.column")
    return read_motion(case)


def settled(case, column, balls):
    """The balls after they fell dry onto the floor for column.end seconds, with little friction: they pack so densely
    that water which rises through them does not move them."""
    motion = run_balls(case, replace(column, friction=0.05), balls, None)
    return replace(balls, place=motion.place[-1])


def mixed(case, column, balls, top):
    """The balls between the floor and a height (m) in random places, at rest. They leave their lattice as a gas, with
    some fifty nearly elastic collisions each, without gravity and friction, periodic in all directions."""
    gas = replace(column, height=top, end=0.2, periodic=True, friction=0.0, restitution=0.99, gravity=0.0)
    velocity = np.random.default_rng(2).normal(scale=0.3, size=balls.place.shape)
    motion = run_balls(case, gas, replace(balls, velocity=velocity - velocity.mean(axis=0)), None)
    place = motion.place[-1] % [column.width, column.width, top]
    return replace(balls, place=place + [0, 0, balls.diameter.max() / 2])


def run_iterated(case, column, balls, passes, first=None):
    """Balls and flow in turn: a dry run (of the column `first`, if it is given), its flow, balls with its forces …,
    relaxed as those of a mill. [(Motion, Fields)] of each pass."""
    found = []
    case.mkdir()
    forces = None
    for number in range(1, passes + 1):
        now = first if first and number == 1 else column
        folder, flow = case / f"balls_{number}", case / f"flow_{number}"
        motion = run_balls(folder, now, balls, forces)
        run_program(folder, "millAverage", "--dumps", "balls.*.txt", "--dt", TIMESTEP, "--box", 0, 0, 0, column.width,
                    column.width, column.height, "--shape", *column.shape, "--periodic", *("xyz" if column.periodic
                                                                                           else "xy"),
                    "--window", "whole", "--start", now.averages, "-o", "solids.h5")
        make_case(flow, column, balls, "solids", f"../balls_{number}/solids.h5")
        run_program(flow, "slurryFoam")
        found.append((motion, read_fields(flow, column)))
        latest = read_ball_forces(flow / "slurry.h5")
        if forces is not None:
            latest = relaxed(latest, read_ball_forces(forces), RELAXATION)
        forces = case / f"forces_{number}.h5"
        write_ball_forces(forces, latest, flow / "slurry.h5", {"relaxation": RELAXATION})
    return found


def read_motion(case):
    paths = sorted(case.glob("balls.*.txt"), key=lambda path: int(path.name.split(".")[1]))
    tables = []
    for path in paths:
        table = np.loadtxt(path, skiprows=9, ndmin=2)
        tables.append(table[np.argsort(table[:, 0])])
    time = TIMESTEP * np.array([int(path.name.split(".")[1]) for path in paths])
    # Means between two dumps
    floor, fluid = (ledger(case / name, column) for name, column in (("floor.txt", 1), ("fluid.0.txt", None)))
    balls = np.array(tables)
    return Motion(time, balls[:, :, 2:5], balls[:, :, 5:8], per_dump(floor, len(time)), per_dump(fluid, len(time)))


def ledger(path, column):
    if not path.is_file():
        return None
    rows = np.loadtxt(path, ndmin=2)
    # fluid.0.txt: step, then pressure x y z and drag x y z
    return -rows[:, column] if column else rows[:, 3] + rows[:, 6]


def per_dump(values, count):
    """Means of the ten records before each dump; NaN at time 0."""
    if values is None:
        return np.full(count, np.nan)
    return np.concatenate([[np.nan], values[:10 * (count - 1)].reshape(-1, 10).mean(axis=1)])


def read_fields(case, column):
    rows = [(time, folder) for time, folder in foam.times(case) if time > 0]
    height = (np.arange(column.cells) + 0.5) * column.height / column.cells

    def read(name):
        return np.array([foam.read_field(folder / name, column.cells) for _, folder in rows])
    floor = np.loadtxt(case / "postProcessing" / "floorPressure" / "0" / "surfaceFieldValue.dat", ndmin=2)
    time = np.array([time for time, _ in rows])
    return Fields(time, height, read("solidity"), read("U")[..., 2], read("solidsVelocity")[..., 2],
                  np.interp(time, floor[:, 0], floor[:, 1]))
