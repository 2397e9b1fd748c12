# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows a mill in ParaView: walls, charge and slurry together.

    paraview --script=scripts/paraview_mill.py     in a case's folder, or with MILL_CASE=FOLDER in the environment
    Macros > Import new macro…                     the same from ParaView's menu, for the folder in which it was started
    pvbatch scripts/paraview_mill.py CASE PICTURE.png     a picture of the last time; without a display by `xvfb-run -a`

It uses ParaView's own readers: that of OpenFOAM for the case (which needs an empty file CASE/mill.foam), and that of
XDMF for solids.xdmf and slurry.xdmf. Walls are translucent. The charge is where the solidity is above 0.3, coloured by
its speed. The slurry's surface is where its share is 0.5. The averages' times are DEM times; they are shifted to flow
times."""
import os
import sys
from pathlib import Path

from paraview import simple

SOLIDITY, SHARE = 0.3, 0.5
WALLS = ("shell", "lifters")


def flow_of(case):
    """Reader of the OpenFOAM case, or None without a flow."""
    if not (case / "constant" / "polyMesh").is_dir():
        return None
    handle = case / "mill.foam"
    handle.touch()
    reader = simple.OpenFOAMReader(registrationName="flow", FileName=str(handle))
    reconstructed = any((case / name / "alpha.slurry").is_file() for name in os.listdir(case) if name != "0")
    if (case / "processor0").is_dir() and not reconstructed:
        reader.CaseType = "Decomposed Case"
    reader.UpdatePipelineInformation()
    reader.MeshRegions = [region for region in reader.MeshRegions.Available
                          if region == "internalMesh" or region.split("/")[-1] in WALLS]
    reader.CellArrays = ["U", "alpha.slurry", "p_rgh", "solidity"]
    return reader


def show_walls(flow, view):
    """The shell and the lifters, cut open towards the viewer."""
    for wall in WALLS:
        part = simple.ExtractBlock(registrationName=wall, Input=flow, Selectors=[f"//{wall}"])
        shown = simple.Show(part, view)
        shown.ColorArrayName = [None, ""]
        shown.Opacity = 0.18 if wall == "shell" else 0.55
        shown.DiffuseColor = [0.45, 0.5, 0.55]


def show_slurry(flow, view):
    """The slurry's surface, blue."""
    inside = simple.ExtractBlock(registrationName="room", Input=flow, Selectors=["//internalMesh"])
    points = simple.CellDatatoPointData(registrationName="at points", Input=inside)
    body = simple.IsoVolume(registrationName="slurry", Input=points, InputScalars=["POINTS", "alpha.slurry"],
                            ThresholdRange=[SHARE, 1.001])
    shown = simple.Show(body, view)
    shown.ColorArrayName = [None, ""]
    shown.DiffuseColor = [0.15, 0.45, 0.75]
    shown.Opacity = 0.65
    return shown


def show_charge(case, view, time0):
    """The dense charge of solids.xdmf, coloured by its speed."""
    path = case / "solids.xdmf"
    if not path.is_file():
        found = case / "solids.h5"
        path = found.resolve().with_suffix(".xdmf") if found.exists() else path
    if not path.is_file():
        return
    reader = simple.XDMFReader(registrationName="charge", FileNames=[str(path)])
    shifted = simple.TemporalShiftScale(registrationName="flow time", Input=reader, PreShift=-time0)
    points = simple.CellDatatoPointData(registrationName="charge at points", Input=shifted)
    dense = simple.IsoVolume(registrationName="dense charge", Input=points, InputScalars=["POINTS", "solidity"],
                             ThresholdRange=[SOLIDITY, 1.0])
    shown = simple.Show(dense, view)
    simple.ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
    shown.SetScalarBarVisibility(view, True)
    speed = simple.GetColorTransferFunction("velocity")
    speed.ApplyPreset("Inferno (matplotlib)", False)  # True would also take the preset's range, 0 to 1
    bar = simple.GetScalarBar(speed, view)
    bar.Title, bar.ComponentTitle = "speed of the charge, m/s", ""
    bar.Orientation, bar.WindowLocation, bar.ScalarBarLength = "Horizontal", "Lower Center", 0.3
    bar.TitleFontSize, bar.LabelFontSize = 14, 12
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.1f", "%.1f"
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]


def time0_of(case):
    """DEM time at flow time 0, s."""
    path = case / "constant" / "millProperties"
    words = path.read_text().replace(";", " ").split() if path.is_file() else []
    return float(words[words.index("time0") + 1]) if "time0" in words else 0.0


def show(case):
    """Shows everything that the case has in a view; returns the view."""
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1100, 800]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = [0.1, 0.1, 0.1]
    show_charge(case, view, time0_of(case))
    flow = flow_of(case)
    if flow:
        show_walls(flow, view)
        show_slurry(flow, view)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    if flow and len(flow.TimestepValues):
        scene.AnimationTime = flow.TimestepValues[-1]
    view.ResetCamera()
    # Seen from the discharge end, x to the right and y up, from the right and a little from above
    camera = view.GetActiveCamera()
    focus = camera.GetFocalPoint()
    distance = camera.GetDistance()
    camera.SetPosition(focus[0] + 0.45 * distance, focus[1] + 0.35 * distance, focus[2] + 0.85 * distance)
    camera.SetViewUp(0, 1, 0)
    view.ResetCamera()
    for shown in simple.GetRepresentations().values():
        if getattr(shown, "ColorArrayName", [None, ""])[1] == "velocity":
            shown.RescaleTransferFunctionToDataRange(False, True)  # at the time that is shown
    simple.Render(view)
    return view


def main():
    words = [word for word in sys.argv[1:] if not word.startswith("-")]
    case = Path(words[0] if words else os.environ.get("MILL_CASE", ".")).resolve()
    if not (case / "constant").is_dir() and not (case / "solids.xdmf").is_file():
        raise SystemExit(f"paraview_mill: {case} is not a mill's case: it has neither constant/ nor solids.xdmf")
    view = show(case)
    if len(words) > 1:
        simple.SaveScreenshot(words[1], view, ImageResolution=[1100, 800])


main()
