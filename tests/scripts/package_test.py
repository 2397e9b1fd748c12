#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`pip install ./scripts` gives the package to any Python: it is whole there, and needs nothing of the source tree.
Ends with 77 where pip, setuptools or wheel is missing; what needs none of them is tested anyway."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

from report_cases import write_dry

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
NOT_HERE = 77  # CTest's SKIP_RETURN_CODE
MISSING = [name for name in ("pip", "setuptools", "wheel") if not importlib.util.find_spec(name)]
LEFT_OUT = "millfoam.plan"  # needs the tree's programs and template
# Prints where the package is, its version, and its modules; every one is imported
WHAT_IS_THERE = """import importlib, importlib.metadata, pkgutil, millfoam
names = [module.name for module in pkgutil.walk_packages(millfoam.__path__, "millfoam.")]
for name in names:
    importlib.import_module(name)
print(millfoam.__file__, importlib.metadata.version("millfoam"), *names)"""


def modules():
    """Names of the modules and packages below scripts/millfoam."""
    paths = (path.relative_to(SCRIPTS) for path in (SCRIPTS / "millfoam").rglob("*.py"))
    names = {".".join(path.with_suffix("").parts).removesuffix(".__init__") for path in paths}
    return names - {"millfoam"}


@unittest.skipIf(MISSING, "not installed")
class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="package-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        # A build leaves files in its source folder
        source, cls.site = cls.folder / "source", cls.folder / "site"
        shutil.copytree(SCRIPTS / "millfoam", source / "millfoam", ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(SCRIPTS / "pyproject.toml", source)
        subprocess.run([sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet", "--no-deps",
                        "--no-index", "--no-build-isolation", "--root-user-action", "ignore", "--target", cls.site,
                        source], check=True)

    def python(self, *arguments):
        """What Python prints that knows the installed package and none of this tree."""
        environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "MILLFOAM_DIR")}
        code = f"import sys; sys.path.insert(0, {str(self.site)!r})\n"
        done = subprocess.run([sys.executable, "-c", code + arguments[0], *map(str, arguments[1:])], cwd=self.folder,
                              env=environment, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_has_every_module_but_the_plan_and_the_version_of_the_programs(self):
        place, version, *names = self.python(WHAT_IS_THERE).split()
        self.assertEqual(Path(place), self.site / "millfoam" / "__init__.py")
        self.assertEqual(set(names), {name for name in modules() if not name.startswith(LEFT_OUT)})
        self.assertEqual(version,
                         re.search(r"project\(millFoam VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1])

    def test_makes_a_report(self):
        case = write_dry(self.folder / "dry", "Somewhere else")
        self.python("from millfoam.report.build import report_case\n"
                    "open(sys.argv[2], 'w').write(report_case(sys.argv[1]))", case, self.folder / "report.html")
        page = (self.folder / "report.html").read_text()
        self.assertIn("Somewhere else – dry", page)
        for part in ("style.css", "player.js"):
            self.assertIn((SCRIPTS / "millfoam" / "report" / "html" / part).read_text(), page)


class Project(unittest.TestCase):
    def test_asks_for_what_the_package_imports(self):
        project = tomllib.loads((SCRIPTS / "pyproject.toml").read_text())["project"]
        found = set()
        for path in (SCRIPTS / "millfoam").rglob("*.py"):
            found |= set(re.findall(r"^(?:import|from) (\w+)", path.read_text(), re.M))
        foreign = found - sys.stdlib_module_names - {"PIL"} | {"pillow"}
        self.assertEqual(foreign, set(project["dependencies"]))


class Skipped(unittest.TestCase):
    def test_without_pip_this_test_does_not_pass(self):
        with tempfile.TemporaryDirectory(prefix="package-") as folder:
            # Python imports this module when it starts
            (Path(folder) / "sitecustomize.py").write_text(
                "import importlib.util\nfind = importlib.util.find_spec\n"
                "importlib.util.find_spec = lambda name, *of: None if name in ('pip', 'setuptools', 'wheel') else "
                "find(name, *of)\n")
            path = os.pathsep.join(filter(None, (folder, os.environ.get("PYTHONPATH"))))
            done = subprocess.run([sys.executable, __file__, "Installed"], text=True, capture_output=True,
                                  env={**os.environ, "PYTHONPATH": path})
        self.assertEqual((done.returncode, done.stdout),
                         (NOT_HERE, "not installed: pip, setuptools, wheel; scripts/setup --tools installs it\n"),
                         done.stderr)
        self.assertIn("SKIP_RETURN_CODE 77", (Path(__file__).parent / "CMakeLists.txt").read_text())


if __name__ == "__main__":
    program = unittest.main(exit=False)
    if not program.result.wasSuccessful():
        sys.exit(1)
    if MISSING:
        print(f"not installed: {', '.join(MISSING)}; scripts/setup --tools installs it")
        sys.exit(NOT_HERE)
