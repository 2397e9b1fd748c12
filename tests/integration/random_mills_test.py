# SPDX-License-Identifier: GPL-3.0-or-later
"""Random mills: valid ones pass every stage but the two simulations, some also report and plan; broken ones are refused
by file, line and key.

The dry run is replaced by balls at random places inside the lifters. Seeds are fixed; MILLFOAM_RANDOM_MILLS=N takes N
mills instead of 8."""
import copy
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files import foam
from millfoam.files.data_files import read_json
from millfoam.files.mill import read_mill

ROOT = Path(__file__).resolve().parents[2]
TEMPLATE, REPORT = ROOT / "scripts" / "mill_case", ROOT / "scripts" / "report"
MILLS = int(os.environ.get("MILLFOAM_RANDOM_MILLS", 8))
# Of each eight mills, those that are also reported and planned, which takes longest: with plain ends, and a slice
REPORTED, PLANNED = (1, 3, 4, 5, 7), (4,)
AROUND = 48  # cells along the shell of a mill whose cells are counted
CRASHES = ("Traceback", "terminate called", "Segmentation", "Assertion", "core dumped", "sigFpe", "stack smashing")
HARD = {"density": 7800, "youngs_modulus": 2e11, "poisson_ratio": 0.3}
CONTACT = {"restitution": 0.6, "friction": 0.4, "rolling_friction": 0.01}


def random_geometry(rng):
    """A mill of 0.1 to 5 m, whole or a slice, with no lifter or up to 20, some trapezoids."""
    radius = math.exp(rng.uniform(math.log(0.05), math.log(2.5)))
    lifters = {"count": rng.choice([0, 0, 1, 2, 5, 8, 12, 16, 20])}
    if lifters["count"]:
        lifters["height"] = radius * rng.uniform(0.05, 0.12)
        pitch = 2 * math.pi * 0.88 * radius / max(3, lifters["count"])
        lifters["width"] = min(lifters["height"] * rng.uniform(0.8, 1.3), 0.45 * pitch)
        if rng.random() < 0.4:
            lifters["top_width"] = lifters["width"] * rng.uniform(0.5, 1)
    geometry = {"diameter": 2 * radius, "length": radius * rng.uniform(0.8, 2),
                "ends": rng.choice(["plain", "periodic"]), "lifters": lifters}
    if rng.random() < 0.3:
        geometry["slice"] = 0.5 * geometry["length"]
    elif geometry["ends"] == "plain" and rng.random() < 0.5:
        geometry["inlet"] = {"radius": 0.3 * radius}
        if rng.random() < 0.5:
            geometry["grates"] = {"sectors": 6}
    return geometry


def random_counts(rng, lifters, radius):
    """AROUND cells of a mill with an inlet, whose core has half of the columns."""
    count = max(1, lifters["count"])
    pitch = AROUND // count
    share = lifters["width"] * count / (2 * math.pi * radius) if lifters["count"] else 0
    on_lifter = max(1, round(pitch * share)) if share else 0
    counts = {"gap": pitch - on_lifter, "ring": rng.randint(11, 12), "core": AROUND // 8}
    return {**counts, "lifter": on_lifter, "height": 1} if share else counts


def random_charge(rng, geometry, density):
    """One size by its fill, or two or three by their masses."""
    radius = geometry["diameter"] / 2
    largest = radius * rng.uniform(0.05, 0.07)
    if rng.random() < 0.5:
        return {"fill": rng.uniform(0.1, 0.2), "diameter": largest}
    mass = 0.11 * density * math.pi * radius ** 2 * geometry["length"]
    return {"classes": [{"diameter": largest * share, "mass": mass * part * rng.uniform(0.5, 1)}
                        for share, part in ((1, 0.6), (0.8, 0.3), (0.7, 0.1))[:rng.randint(2, 3)]],
            "fines_below": largest * rng.choice([0, 0.75])}


def random_mill(rng):
    """A valid mill.yaml as nested dictionaries; some thousand balls, six records."""
    geometry = random_geometry(rng)
    radius, lifters = geometry["diameter"] / 2, geometry["lifters"]
    named = rng.random() < 0.5
    speed = ({"angular_velocity": rng.choice([-1, 1]) * rng.uniform(0.3, 0.9) * math.sqrt(9.81 / radius)}
             if rng.random() < 0.3 else
             {"fraction_of_critical": rng.uniform(0.3, 0.95), "sense": rng.choice(["clockwise", "anticlockwise"])})
    start = rng.choice([{"level": rng.uniform(-0.6, 0) * radius}, {"fill": rng.uniform(0.3, 1.2)},
                        {"volume": 0.05 * math.pi * radius ** 2 * geometry["length"]}])
    record, cell = 0.01 * math.sqrt(radius), radius / rng.uniform(7, 12)
    mill = {"title": "random mill", "geometry": geometry, "speed": speed,
            "charge": random_charge(rng, geometry, 2700 if named else HARD["density"]),
            "materials": ({"ball": "glass", "wall": rng.choice(["HDPE", "nylon", "perspex", "aluminium"])} if named else
                          {"ball": dict(HARD), "wall": dict(HARD), "ball_ball": dict(CONTACT),
                           "ball_wall": dict(CONTACT)}),
            "dem": {"settle_time": 0.1, "record_interval": record, "duration": 6 * record, "seed": rng.randint(1, 9999),
                    rng.choice(["youngs_modulus", "largest_overlap"]): None},
            "averages": {"voxel_size": radius / rng.uniform(7, 9), "window": 3 * record, "start": 0,
                         "method": rng.choice(["exact", "sample"])},
            "slurry": {"density": rng.uniform(1000, 2000), "plastic_viscosity": 10 ** rng.uniform(-3, 0),
                       "yield_stress": rng.choice([0, 10 ** rng.uniform(-2, 2)])},
            "resolution": {"cell_size": cell, "layers": max(4, round(geometry["length"] / (rng.uniform(1, 2) * cell)))},
            "flow": {"duration": rng.uniform(0.02, 2), "start": start,
                     "law": rng.choice(["Beetstra", "Hill", "DiFelice"])}}
    dem = mill["dem"]
    dem.update({key: {"youngs_modulus": 1e8, "largest_overlap": 0.06}[key] for key in dem if dem[key] is None})
    if geometry["ends"] == "plain" and rng.random() < 0.5:
        mill["resolution"]["last_layer"] = rng.uniform(0.5, 1) * geometry["length"] / mill["resolution"]["layers"]
    if "grates" in geometry:
        mill["flow"]["feed"] = 0.01 * radius ** 3
    elif "inlet" in geometry:
        # One cell on a narrow top beside one in a gap differ too much
        if AROUND % max(1, lifters["count"]) == 0 and "top_width" not in lifters and rng.random() < 0.7:
            del mill["resolution"]["cell_size"]
            mill["resolution"]["counts"] = random_counts(rng, lifters, radius)
    mill["flow"]["coupling"] = rng.choice(["one_way", "iterated", "direct"])
    return mill


def written(mill):
    """(text of mill.yaml, line of each key by its path)."""
    lines, places = [], {}

    def write(value, path, indent):
        for key, inner in value.items():
            at = f"{path}.{key}" if path else key
            nested = isinstance(inner, dict) and inner
            lines.append(f"{indent}{key}:" + ("" if nested else f" {json.dumps(inner)}"))
            places[at] = len(lines)
            if nested:
                write(inner, at, indent + "  ")

    write(mill, "", "")
    return "\n".join(lines) + "\n", places


def leaves(mill, path=""):
    """Paths of the keys of a mill whose values are neither maps nor lists."""
    for key, value in mill.items():
        if isinstance(value, dict):
            yield from leaves(value, f"{path}{key}.")
        elif not isinstance(value, list):
            yield f"{path}{key}"


def holder(mill, path):
    """(the map that holds the path's last key, that key)."""
    *sections, key = path.split(".")
    for section in sections:
        mill = mill[section]
    return mill, key


def apart(rng, radii, mill):
    """(radius, distance from the axis, angle, z) of balls at random places, of which no two overlap; away from the
    lifters, where so few balls would not fill the voxels evenly."""
    room = 0.85 * (mill.radius - mill.lifters[1])
    plain = mill.asked("geometry", "ends") == "plain" and not mill.is_slice
    placed = np.empty((0, 4))  # x, y, z, radius
    for r in sorted(radii, reverse=True):
        end = r if plain else 0
        for _ in range(10000):
            rho, angle = (room - r) * math.sqrt(rng.random()), rng.uniform(0, 2 * math.pi)
            at = np.array([rho * math.cos(angle), rho * math.sin(angle), rng.uniform(end, mill.length - end)])
            gap = np.abs(placed[:, :3] - at)
            if not plain:
                gap[:, 2] = np.minimum(gap[:, 2], mill.length - gap[:, 2])
            if ((gap ** 2).sum(axis=1) >= (placed[:, 3] + r) ** 2).all():
                break
        else:
            raise AssertionError(f"no place for ball {len(placed)} of {len(radii)}")
        placed = np.vstack([placed, [*at, r]])
    return [(r, math.hypot(x, y), math.atan2(y, x), z) for x, y, z, r in placed.tolist()]


def ran(folder, *command):
    """(exit code, all output) of a program in a folder."""
    environment = {**os.environ, "PWD": str(Path(folder).resolve())}
    done = subprocess.run([str(word) for word in command], cwd=folder, env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace")
    return done.returncode, done.stdout


class MillTest(unittest.TestCase):
    def setUp(self):
        self.case = Path(tempfile.mkdtemp(prefix="random-mills-"))
        self.addCleanup(shutil.rmtree, self.case)

    def pass_stage(self, *command):
        """Output of a stage that must not fail."""
        code, output = ran(self.case, *command)
        name = Path(command[0]).name
        self.assertEqual(code, 0, f"{name} of\n{(self.case / 'mill.yaml').read_text()}\n{output[-3000:]}")
        for word in CRASHES:
            self.assertNotIn(word, output, name)
        return output

    def pass_stages(self, mill, rng, *changes):
        """Takes a mill from its YAML to the flow's start, with balls at random places instead of a dry run."""
        (self.case / "mill.yaml").write_text(written(mill)[0])
        shutil.copytree(TEMPLATE, self.case, dirs_exist_ok=True, ignore=shutil.ignore_patterns("interFoam"))
        words = [word for change in changes for word in ("--set", change)]
        self.pass_stage("millMesh", "mill.yaml", *words, "--resolved", "mill.json")
        self.pass_stage("millMesh", "mill.json", "--case", ".", "--walls")
        self.pass_stage("millDem", "mill.json", "--case", ".", "--deck-only")
        self.write_dumps(rng)
        self.pass_stage("millAverage", "mill.json", "--case", ".")
        self.pass_stage("millMesh", "mill.json", "--case", ".")
        shutil.copytree(self.case / "0.orig", self.case / "0")
        self.pass_stage("slurryStart")

    def write_dumps(self, rng):
        """Dumps and run.json of balls that move rigidly with the mill, in a place that no lifter comes to."""
        plan = read_json(self.case / "dem" / "plan.json", "dem-plan")
        mill = read_mill(self.case)
        sizes = [one["diameter_m"] / 2 for one in mill.content["derived"]["charge"]["classes"] if one["simulated"]
                 for _ in range(one["count"])]
        balls = apart(rng, sizes, mill)
        dumps = self.case / "dumps"
        dumps.mkdir()
        for record in range(plan["dumps"]):
            step = record * plan["interval"]
            flags, along = ("ff ff pp", f"0 {mill.length!r}") if mill.is_slice else ("ff ff ff", "-9 9")
            lines = ["ITEM: TIMESTEP", str(step), "ITEM: NUMBER OF ATOMS", str(len(balls)), f"ITEM: BOX BOUNDS {flags}",
                     "-9 9", "-9 9", along, "ITEM: ATOMS id type x y z vx vy vz radius"]
            for number, (r, rho, angle, z) in enumerate(balls, start=1):
                now = angle + mill.omega * step * plan["timestep_s"]
                x, y = rho * math.cos(now), rho * math.sin(now)
                lines.append(f"{number} 1 {x!r} {y!r} {z!r} {-mill.omega * y!r} {mill.omega * x!r} 0 {r!r}")
            (dumps / f"dump.{step}.txt").write_text("\n".join(lines) + "\n")
        (dumps / "run.json").write_text(json.dumps({
            "format": "millfoam-dumps", "program": "random_mills_test", "mill": plan["mill"],
            "timestep_s": plan["timestep_s"], "interval": plan["interval"], "angular_velocity_rad_s": mill.omega,
            "duration_s": plan["duration_s"]}))


class Valid(MillTest):
    def test_random_mills_pass_every_stage(self):
        for seed in range(MILLS):
            rng = random.Random(seed)
            with self.subTest(seed=seed):
                self.setUp()
                self.pass_stages(random_mill(rng), rng)
                if seed % 8 in REPORTED:
                    self.pass_stage(REPORT, ".")
                    self.assertIn("random mill", (self.case / "report.html").read_text())
                if seed % 8 in PLANNED:
                    self.pass_plan()

    def pass_plan(self):
        """What a resolved mill will take is found, and is of this mill."""
        self.pass_stage(sys.executable, "-m", "millfoam.plan", ".")
        plan, mesh = read_json(self.case / "plan.json", "plan"), read_json(self.case / "mesh.json", "mesh")
        self.assertEqual((plan["mill"], plan["cells"]), (read_mill(self.case).fingerprint, mesh["cells"]))
        for stage in plan["stages"]:
            for key in ("time_s", "disk_bytes", "memory_bytes"):
                self.assertGreater(stage[key], 0, f"{stage['stage']}: {key}")


class OneChange(MillTest):
    """A number is set in one place: every file of every stage has it."""

    def test_a_number_that_is_set_is_the_same_everywhere(self):
        rng = random.Random(1)
        mill = random_mill(rng)
        mill["geometry"] = {"diameter": 0.6, "length": 0.2, "ends": "periodic", "lifters": {"count": 8}}
        mill["charge"] = {"fill": 0.15, "diameter": 0.035}
        mill["speed"] = {"fraction_of_critical": 0.7, "sense": "anticlockwise"}
        mill["materials"] = {"ball": dict(HARD), "wall": dict(HARD), "ball_ball": dict(CONTACT),
                             "ball_wall": dict(CONTACT)}
        mill["resolution"] = {"cell_size": 0.05, "layers": 2}
        mill["flow"]["start"] = {"fill": 1}
        mill["averages"]["voxel_size"] = 0.04
        self.pass_stages(mill, rng, "geometry.lifters.height=0.0277", "slurry.density=1357",
                         "materials.ball.density=3141", "speed.fraction_of_critical=0.613")
        self.pass_stage(REPORT, ".")
        omega = 0.613 * math.sqrt(9.81 / 0.3)
        resolved = read_json(self.case / "mill.json", "mill")
        self.assertEqual(resolved["derived"]["geometry"]["lifters"]["height_m"], 0.0277)
        self.assertEqual(resolved["derived"]["slurry"]["density_kg_m3"], 1357)
        self.assertEqual(resolved["derived"]["materials"]["ball"]["density_kg_m3"], 3141)
        self.assertAlmostEqual(resolved["derived"]["speed"]["angular_velocity_rad_s"], omega, delta=1e-12)

        properties = foam.read_dictionary(self.case / "constant" / "millProperties")
        self.assertEqual([float(properties[key]) for key in ("lifterHeight", "slurryDensity", "ballDensity")],
                         [0.0277, 1357, 3141])
        self.assertAlmostEqual(float(properties["omega"]), omega, delta=1e-12)

        deck = (self.case / "dem" / "in.mill").read_text()
        self.assertEqual(set(re.findall(r"density constant (\S+)", deck)), {"3141"})
        period = float(re.search(r"rotate.* period (\S+)", deck).group(1))
        self.assertAlmostEqual(2 * math.pi / abs(period), omega, delta=1e-6)

        mill = read_mill(self.case)
        self.assertEqual(mill.lifters[1], 0.0277)
        self.assertEqual(mill.slurry("density_kg_m3"), 1357)
        self.assertAlmostEqual(mill.omega, omega, delta=1e-12)

        report = (self.case / "report.html").read_text()
        for words in ("height_m: 0.0277", "density_kg_m3: 1357", "density_kg_m3: 3141",
                      "geometry.lifters.height=0.0277"):
            self.assertIn(words, report.replace('"', "").replace("&quot;", ""), words)
        tips = self.lifter_tips()
        self.assertAlmostEqual(tips, 0.3 - 0.0277, delta=1e-6)

    def lifter_tips(self):
        """Least height of the lifters' tops over the axis, of the walls that LIGGGHTS gets (m)."""
        points = re.findall(r"vertex (\S+) (\S+) \S+", (self.case / "walls" / "lifters.stl").read_text())
        # Lifter 1 is on +x: its flat top is at x = R - height
        return min(float(x) for x, y in points if float(x) > 0.2 and abs(float(y)) < 0.02)


class Broken(MillTest):
    def refused(self, text, *words, line=None, change=None, tool="millMesh"):
        """The text of a mill, bytes or str, is refused with exit 1 and one sentence with these words."""
        path = self.case / "mill.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        options = ["--set", change] if change else []
        code, output = ran(self.case, tool, "mill.yaml", *options, "--resolved", "mill.json")
        shown = f"{tool} {' '.join(options)}: exit {code}: {output[:600]}"
        self.assertEqual(code, 1, shown)
        for word in CRASHES:
            self.assertNotIn(word, output, shown)
        self.assertFalse((self.case / "mill.json").exists(), shown)
        place = f"error: --set {change}: " if change else f"error: mill.yaml:{line}: " if line else "error: mill.yaml"
        for word in (place, *words):
            self.assertIn(word, output, shown)

    def broken(self, mill, path, value, *words, **options):
        """Refused with `value` for a key."""
        changed = copy.deepcopy(mill)
        inner, key = holder(changed, path)
        inner[key] = value
        text, places = written(changed)
        self.refused(text, f"key '{path}'", "expected", *words, line=places[path], **options)

    def each_mill(self, count=max(1, MILLS // 2)):
        for seed in range(count):
            with self.subTest(seed=seed):
                yield random.Random(1000 + seed), random_mill(random.Random(seed))

    def test_values_of_another_kind(self):
        for rng, mill in self.each_mill():
            texts = ("title", "ball", "wall", "sense", "ends", "law", "method")
            for path in leaves(mill):
                name = path.rsplit(".", 1)[-1]
                if name == "title":
                    continue
                value = rng.choice([["a", "list"], None] + ([] if name in texts else ["many", ".nan", "0.1 m"]))
                with self.subTest(path=path, value=value):
                    self.broken(mill, path, value, tool=rng.choice(["millMesh", "millDem"]))

    def test_numbers_that_cannot_be(self):
        signed = ("angular_velocity", "level")
        for rng, mill in self.each_mill():
            for path in leaves(mill):
                inner, key = holder(mill, path)
                if isinstance(inner[key], str):
                    continue
                if key not in signed:
                    with self.subTest(path=path, value=-3):
                        self.broken(mill, path, -3)
                        self.refused(written(mill)[0], f"key '{path}'", change=f"{path}=-3")
                for value in (".nan", ".inf", "-.inf", "1e999"):
                    with self.subTest(path=path, value=value):
                        self.refused(written(mill)[0], f"key '{path}'", change=f"{path}={value}")

    def test_numbers_out_of_every_range(self):
        for rng, mill in self.each_mill(3):
            for path in leaves(mill):
                inner, key = holder(mill, path)
                if isinstance(inner[key], str):
                    continue
                with self.subTest(path=path):
                    (self.case / "mill.yaml").write_text(written(mill)[0])
                    for tool in (("millMesh", "--quality"), ("millDem", "--case", ".", "--deck-only")):
                        code, output = ran(self.case, tool[0], "mill.yaml", *tool[1:], "--set", f"{path}=1e300")
                        self.assertEqual(code, 1, output[-500:])
                        self.assertIn(f"error: --set {path}=1e300: key '{path}' = 1e300: expected", output)
                        for word in CRASHES:
                            self.assertNotIn(word, output)

    def test_keys_that_are_not_known(self):
        for rng, mill in self.each_mill():
            for path in rng.sample(sorted(leaves(mill)), 6):
                changed = copy.deepcopy(mill)
                inner, key = holder(changed, path)
                place = rng.randrange(len(key) - 1)
                misspelt = key[:place] + key[place:place + 1] + key[place:]
                inner[misspelt] = inner.pop(key)
                text, places = written(changed)
                at = path[:len(path) - len(key)] + misspelt
                with self.subTest(path=at):
                    self.refused(text, f"key '{at}' is unknown: did you mean '", line=places[at])
                section = path.rpartition(".")[0]
                other = f"{section}.lining" if section else "lining"
                self.refused(written(mill)[0], f"key '{other}' is unknown", "known here: ", change=f"{other}=3")

    def test_keys_that_are_missing(self):
        required = ["geometry", "geometry.diameter", "geometry.length", "geometry.ends", "geometry.lifters",
                    "geometry.lifters.count", "speed", "charge", "materials", "materials.ball", "slurry",
                    "slurry.density", "slurry.plastic_viscosity", "slurry.yield_stress"]
        for rng, mill in self.each_mill():
            for path in required:
                changed = copy.deepcopy(mill)
                inner, key = holder(changed, path)
                del inner[key]
                text, places = written(changed)
                line = places.get(path.rpartition(".")[0], 1)
                with self.subTest(path=path):
                    self.refused(text, f"key '{path}' is missing: expected", line=line)

    def test_lists_and_texts_for_maps(self):
        for rng, mill in self.each_mill():
            for section in ("geometry", "geometry.lifters", "speed", "charge", "materials", "dem", "slurry",
                            "flow.start"):
                with self.subTest(section=section):
                    self.broken(mill, section, rng.choice([[1, 2], "text", 7]))

    def test_two_alternatives(self):
        for _, mill in self.each_mill(4):
            mill["geometry"]["lifters"] = {"count": 8}
            mill["speed"] = {"fraction_of_critical": 0.7, "sense": "clockwise"}
            mill["charge"] = {"fill": 0.2, "diameter": 0.1 * mill["geometry"]["diameter"] / 2}
            for section, key, value, other in (
                    ("speed", "angular_velocity", 1, "fraction_of_critical"), ("charge", "classes", [], "fill"),
                    ("flow", "turns", 1, "turns"), ("averages", "voxel_size", 0.01, "voxel_size"),
                    ("resolution", "counts", {"gap": 2, "lifter": 1, "height": 1, "ring": 5}, "cell_size"),
                    ("dem", "largest_overlap", 0.05, "largest_overlap"), ("slurry", "level", 0, None)):
                changed = copy.deepcopy(mill)
                changed["dem"].pop("largest_overlap", None)
                changed["dem"]["youngs_modulus"] = 1e8
                if key == "voxel_size":
                    changed["averages"]["counts"] = {"across": 8, "along": 2}
                changed[section][key] = value
                text, places = written(changed)
                path = f"{section}.{other}" if other else "flow.start"
                with self.subTest(key=key):
                    self.refused(text, f"key '{path}'", "either", line=places[path])

    def test_texts_in_another_encoding(self):
        for _, mill in self.each_mill(3):
            text = written(mill)[0]
            line = text[:text.index("speed:")].count("\n") + 1
            tabbed = text.replace("speed:\n  ", "speed:\n\t", 1)
            self.refused(tabbed, "a tab", line=line + 1)
            self.refused(text.replace('"random mill"', "M\xfchle").encode("latin-1"), "Latin-1", "UTF-8", line=1)
            for encoding in ("utf-16", "utf-16-le", "utf-16-be"):
                self.refused(text.encode(encoding), "UTF-16", "UTF-8")
            self.refused("", "empty", line=1)
            self.refused(text + text, "given twice")
            self.refused(text[:text.index("speed:")] + "speed: {", "not valid YAML")

    def test_python_reads_no_broken_mill(self):
        for content in ("", "{", '{"format": "millfoam-mill"}', '{"format": "millfoam-mesh"}', "[" * 5000):
            (self.case / "mill.json").write_text(content)
            code, output = ran(self.case, REPORT, ".")
            self.assertEqual(code, 1, output)
            self.assertIn("mill.json", output)
            self.assertNotIn("Traceback", output)


if __name__ == "__main__":
    unittest.main(verbosity=2)
