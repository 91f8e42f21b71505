"""The state that tools/paraview opens; runs inside ParaView. What to open comes by the environment: PERIMORPH_FILES (the
series, a name a line), PERIMORPH_WARP, and PERIMORPH_STATE if the state is to be written to a file."""

import os

import paraview.simple as pv

# The element variable "class": number, name, colour, as in runs.py, which is out of reach inside ParaView.
CLASSES = [("0", "FE", (0.78, 0.83, 0.88)), ("1", "MORPH", (0.96, 0.72, 0.32)), ("2", "PD", (0.42, 0.62, 0.80)),
           ("3", "DGFE", (0.76, 0.20, 0.22))]
DAMAGED = 0.3  # beside a straight crack elements lose about 40 % of their bonds


SURFACE = "broken_surface"  # the side set of crack faces


def open_series(files, name, side_sets):
    """All files as one series, its blocks, or side sets alone. Variables keep their names (no merged vectors), and blocks
    stay apart."""
    reader = pv.IOSSReader(registrationName=name, FileName=files)
    reader.ScanForRelatedFiles = 0
    reader.ApplyDisplacements = 0
    reader.FieldSuffixSeparator = "|"
    reader.UpdatePipelineInformation()
    reader.NodeSets, reader.SideSets = [], side_sets
    if side_sets:
        reader.ElementBlocks = []
    reader.UpdatePipeline()
    return reader


def warped(reader, factor, name):
    axes = [axis for axis in "xyz" if f"displacement_{axis}" in reader.PointData.keys()]
    terms = [f"{axis.replace('x', 'i').replace('y', 'j').replace('z', 'k')}Hat*displacement_{axis}" for axis in axes]
    vector = pv.Calculator(registrationName=f"displacement of {name}", Input=reader, AttributeType="Point Data",
                           ResultArrayName="displacement", Function=" + ".join(terms))
    return pv.WarpByVector(registrationName=name, Input=vector, Vectors=["POINTS", "displacement"], ScaleFactor=factor)


def colour_by_class(display, view):
    pv.ColorBy(display, ("CELLS", "class"))
    table = pv.GetColorTransferFunction("class")
    table.InterpretValuesAsCategories = 1
    table.Annotations = [text for number, name, _ in CLASSES for text in (number, name)]
    table.IndexedColors = [part for _, _, colour in CLASSES for part in colour]
    table.IndexedOpacities = [1.0] * len(CLASSES)
    display.SetScalarBarVisibility(view, True)


def damaged(body):
    part = pv.Threshold(registrationName=f"damage above {DAMAGED}", Input=body, Scalars=["CELLS", "damage"])
    part.ThresholdMethod = "Above Upper Threshold"
    part.UpperThreshold = DAMAGED
    return part


def slice_of(body):
    cut = pv.Slice(registrationName="slice", Input=body)
    low, high = body.GetDataInformation().GetBounds()[0::2], body.GetDataInformation().GetBounds()[1::2]
    cut.SliceType.Origin = [0.5 * (a + b) for a, b in zip(low, high)]
    cut.SliceType.Normal = [1.0, 0.0, 0.0]
    return cut


def hide_ready(part, view):
    """Coloured by damage, and shown when asked for."""
    display = pv.Show(part, view)
    pv.ColorBy(display, ("CELLS", "damage"))
    pv.GetColorTransferFunction("damage").RescaleTransferFunction(0.0, 1.0)
    display.SetScalarBarVisibility(view, False)
    pv.Hide(part, view)


def main():
    view = pv.GetActiveViewOrCreate("RenderView")
    files, warp = os.environ["PERIMORPH_FILES"].split("\n"), float(os.environ["PERIMORPH_WARP"])
    reader = open_series(files, "series", [])
    last = reader.TimestepValues[-1]
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = view.ViewTime = last
    body = warped(reader, warp, "warped")
    body.UpdatePipeline(last)
    display = pv.Show(body, view)
    colour_by_class(display, view)
    for part in (damaged(body), slice_of(body)):
        part.UpdatePipeline(last)
        hide_ready(part, view)
    surface = warped(open_series(files, "crack faces", [SURFACE]), warp, "broken surface")
    pv.Show(surface, view).ColorArrayName = ["POINTS", ""]
    pv.Hide(surface, view)
    scene.AnimationTime = last  # showing parts may set it back
    pv.SetActiveSource(body)
    low, high = reader.GetDataInformation().GetBounds()[4:6]
    view.InteractionMode = "2D" if low == high else "3D"
    view.ResetCamera(False)
    pv.Render(view)
    if "PERIMORPH_STATE" in os.environ:
        pv.SaveState(os.environ["PERIMORPH_STATE"])
        print(os.environ["PERIMORPH_STATE"])


main()
