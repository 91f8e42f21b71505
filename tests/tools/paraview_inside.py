"""Runs inside ParaView: loads a state of tools/paraview, prints what it holds, and saves a picture beside it.

    pvbatch paraview_inside.py FILE.pvsm

Leaving by sys.exit() would end in an X error: ParaView then takes its views down in the wrong order.
"""

import sys

import paraview.simple as pv

state = sys.argv[1]
pv.LoadState(state)
view = pv.GetActiveViewOrCreate("RenderView")
view.ViewSize = [700, 600]
pv.Render(view)
pv.SaveScreenshot(state.replace(".pvsm", ".png"), view)
sources = {name: source for (name, _), source in pv.GetSources().items()}
last, counts = view.ViewTime, {}
for time in sources["series"].TimestepValues:
    for source in sources.values():
        source.UpdatePipeline(time)
    counts[time] = {name: source.GetDataInformation().GetNumberOfCells() for name, source in sources.items()}
shown = [part.Input for part in view.Representations if hasattr(part, "Input") and part.Visibility]
visible = [name for name, source in sources.items() if source in shown]
print({"last": last, "counts": counts, "visible": visible, "warp": sources["warped"].ScaleFactor})
