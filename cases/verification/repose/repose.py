# SPDX-License-Identifier: GPL-3.0-or-later
"""A pile of balls on a ledge: LIGGGHTS fills a box, whose gate opens, and what stays is a slope.

The ledge reaches from a wall at x = 0 to its edge, which has a lip of one diameter that holds the lowest layer: on a
smooth floor that would roll away. The box is periodic along y. Balls are placed on a lattice at random distances and
orientations, fall, and come to rest. Then the gate above the edge is taken away, balls run over the edge, and leave.
The slope of those that stay is the angle of repose."""
from dataclasses import dataclass
from math import gamma
from pathlib import Path

import numpy as np

from millfoam.files.constants import GRAVITY
from millfoam.files.dumps import read_balls
from millfoam.run import run

DIAMETER, DENSITY = 0.005, 2700.0  # m, of the sphere of a ball's volume; kg/m3
MODULUS, POISSON, RESTITUTION, FRICTION = 1e7, 0.3, 0.6, 0.4
FLOOR_FRICTION = 0.8  # so that the pile does not slide as a whole
TIMESTEP = 1.5e-5  # s
SETTLE, RUN_OUT = 0.3, 1.2  # s, before and after the gate opens
CURVATURE_LIMIT = 10
MODEL = "gran model hertz tangential history rolling_friction cdt"
PLACED = 1.3  # distance of the lattice, in diameters: the longest ball with room to turn
MARGIN = 2  # diameters from the wall and from the edge, which the slope leaves out
SLOW, MOVING = 0.05, 0.03  # m/s; share of the balls that may be faster: single ones roll down for long
LEAST_HEIGHT = 2.5  # diameters, of the surface at the wall

DECK = """units si
atom_style {style}
atom_modify map array
newton off
communicate single vel yes
boundary f p f
region box block -0.005 {right} 0 {width} -0.03 {top} units box
create_box 2 box
neighbor 0.001 bin
neigh_modify delay 0
fix youngs all property/global youngsModulus peratomtype {modulus} {modulus}
fix poisson all property/global poissonsRatio peratomtype {poisson} {poisson}
fix restitution all property/global coefficientRestitution peratomtypepair 2 {e} {e} {e} {e}
fix friction all property/global coefficientFriction peratomtypepair 2 {mu} {floor_mu} {floor_mu} {floor_mu}
fix rolling all property/global coefficientRollingFriction peratomtypepair 2 0 0 0 0
pair_style {model}
pair_coeff * *
timestep {timestep}
fix gravity all gravity {gravity} vector 0 0 -1
fix floor all mesh/surface file floor.stl type 2
fix gate all mesh/surface file gate.stl type 2
fix closed all wall/{wall_model} mesh n_meshes 2 meshes floor gate {settings}
{balls}
fix motion all {motion}
thermo_modify lost ignore
run {settle}
unfix closed
unfix gate
fix open all wall/{wall_model} mesh n_meshes 1 meshes floor {settings}
dump end all custom {end} dump.*.txt id x y z vx vy vz
run {run_out}
"""


@dataclass(frozen=True)
class Shape:
    """Balls of a shape: half axes over each other and blockiness of a superquadric, or None of LIGGGHTS' spheres."""
    name: str
    axes: tuple[float, float, float] | None = None
    blockiness: float = 2.0

    @property
    def program(self) -> str:
        """The program that computes them."""
        return "millLiggghts" if self.axes is None else "millLiggghtsSuperquadric"


@dataclass(frozen=True)
class Ledge:
    """Size of the box in ball diameters: along x up to the edge, along y, and layers of the lattice."""
    length: int
    width: int
    layers: int


def triangles(*corners: tuple[float, float, float]) -> str:
    """The two triangles of a rectangle of four corners in turn, in STL."""
    words = []
    for three in ((0, 1, 2), (0, 2, 3)):
        words += ["facet normal 0 0 0", "outer loop"]
        words += ["vertex " + " ".join(f"{value:.9g}" for value in corners[k]) for k in three]
        words += ["endloop", "endfacet"]
    return "\n".join(words)


def scaled_axes(shape: Shape) -> np.ndarray:
    """Half axes of the superquadric of a ball's volume, m (Dirichlet's integral)."""
    part = 1 / shape.blockiness
    unit = 8 * np.prod(shape.axes) * gamma(1 + part)**3 / gamma(1 + 3 * part)
    return np.array(shape.axes) * np.cbrt(np.pi / 6 * DIAMETER**3 / unit)


def place_balls(shape: Shape, ledge: Ledge, seed: int) -> tuple[list[str], float]:
    """LIGGGHTS' lines for balls on a lattice, moved at random, and the height that they need, m."""
    random = np.random.default_rng(seed)
    step = PLACED * DIAMETER
    counts = int(ledge.length * DIAMETER / step), int(ledge.width * DIAMETER / step), ledge.layers
    gap = np.array([ledge.length * DIAMETER / counts[0], ledge.width * DIAMETER / counts[1], step])
    lines, number = [], 0
    for k in range(counts[2]):
        for j in range(counts[1]):
            for i in range(counts[0]):
                number += 1
                place = (np.array([i, j, k]) + 0.5 + random.uniform(-0.05, 0.05, 3)) * gap
                turn = random.normal(size=4)
                turn /= np.linalg.norm(turn)
                lines.append("create_atoms 1 single " + " ".join(f"{value:.9g}" for value in place) + " units box")
                if shape.axes is None:
                    lines.append(f"set atom {number} diameter {DIAMETER} density {DENSITY}")
                else:
                    axes = " ".join(f"{value:.9g}" for value in scaled_axes(shape))
                    lines.append(f"set atom {number} shape {axes} blockiness {shape.blockiness} {shape.blockiness} "
                                 "quat_direct " + " ".join(f"{value:.9g}" for value in turn))
                    lines.append(f"set atom {number} density {DENSITY}")
    return lines, counts[2] * step


def run_pile(folder: Path, shape: Shape, ledge: Ledge, seed: int) -> np.ndarray:
    """Makes a pile in a new folder. Places of the balls that stay on the ledge [n, 3], m. RunError if LIGGGHTS fails;
    RuntimeError if the pile does not come to rest."""
    folder.mkdir(parents=True)
    lines, height = place_balls(shape, ledge, seed)
    length, width, top = ledge.length * DIAMETER, ledge.width * DIAMETER, height + 2 * DIAMETER
    over = (0.0, width)
    floor = triangles((0, over[0], 0), (length, over[0], 0), (length, over[1], 0), (0, over[1], 0))
    wall = triangles((0, over[0], 0), (0, over[1], 0), (0, over[1], top), (0, over[0], top))
    gate = triangles((length, over[0], DIAMETER), (length, over[1], DIAMETER), (length, over[1], top),
                     (length, over[0], top))
    lip = triangles((length, over[0], 0), (length, over[1], 0), (length, over[1], DIAMETER),
                    (length, over[0], DIAMETER))
    (folder / "floor.stl").write_text(f"solid floor\n{floor}\n{wall}\n{lip}\nendsolid floor\n")
    (folder / "gate.stl").write_text(f"solid gate\n{gate}\nendsolid gate\n")
    shaped = shape.axes is not None
    settings = f"curvatureLimitFactor {CURVATURE_LIMIT} meanCurvature yes" if shaped else ""
    motion = "nve/superquadric integration_scheme 1" if shaped else "nve/sphere"
    last = steps(SETTLE) + steps(RUN_OUT)
    model = MODEL + (" surface superquadric" if shaped else "")
    (folder / "in.pile").write_text(DECK.format(
        style="superquadric" if shaped else "granular", right=length + 0.05, width=width, top=top, gravity=GRAVITY,
        modulus=MODULUS, poisson=POISSON, e=RESTITUTION, mu=FRICTION, floor_mu=FLOOR_FRICTION,
        model=f"{model} {settings}", wall_model=model, settings=settings, timestep=TIMESTEP, balls="\n".join(lines),
        settle=steps(SETTLE), run_out=steps(RUN_OUT), end=last, motion=motion))
    run(folder, shape.program, "-in", "in.pile", "-log", "none")
    balls = read_balls(folder / f"dump.{last}.txt", "x", "y", "z", "vx", "vy", "vz")
    stay = balls[(balls[:, 2] > 0) & (balls[:, 0] < length)]
    moving = (np.linalg.norm(stay[:, 3:], axis=1) > SLOW).mean()
    if not moving < MOVING:
        raise RuntimeError(f"{folder}: {100 * moving:.2g} % of {len(stay)} balls on the ledge move faster than {SLOW} "
                           f"m/s; expected a pile at rest, less than {100 * MOVING:g} %")
    return stay[:, :3]


def steps(time: float) -> int:
    """Steps of a time, s."""
    return round(time / TIMESTEP)


def slope(balls: np.ndarray, ledge: Ledge) -> float:
    """Angle of the surface of a pile of balls [n, 3] (m) against the horizontal, degrees: a plane along y through the
    highest ball of each column of a diameter squared, without MARGIN at both ends. RuntimeError if that is less than
    LEAST_HEIGHT high at the wall: a longer ledge is needed."""
    cells = (balls[:, :2] / DIAMETER).astype(int)
    cells[:, 1] = np.clip(cells[:, 1], 0, ledge.width - 1)  # periodic: a ball may be just outside
    highest = np.full((ledge.length, ledge.width), -np.inf)
    np.maximum.at(highest, (cells[:, 0], cells[:, 1]), balls[:, 2])
    middles = np.broadcast_to((np.arange(ledge.length)[:, None] + 0.5) * DIAMETER, highest.shape)
    chosen = np.isfinite(highest)
    chosen[:MARGIN] = chosen[ledge.length - MARGIN:] = False
    line = np.polyfit(middles[chosen], highest[chosen], 1)
    if line[1] < LEAST_HEIGHT * DIAMETER:
        raise RuntimeError(f"a pile of {line[1] / DIAMETER:.2g} diameters at the wall; expected {LEAST_HEIGHT:g} or "
                           "more: a longer ledge")
    return float(np.degrees(np.arctan(-line[0])))
