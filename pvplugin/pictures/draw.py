"""Draws the pictures of built-in scenes that the scene picker shows: the last frame of each, from stored runs.

  for scene in $(cd data/scenes && ls | sed s/.toml//); do lamella run $scene --no-pictures -o RUNS/$scene; done
  LAMELLA_PLUGIN=.../Lamella.so pvpython draw.py RUNS
  mogrify -resize 96x96 +dither -colors 200 *.png

Runs with --preset draft do not do: on their grids some vesicles end otherwise.
"""

import os
import sys

from paraview import simple

SIZE = 96
FINER = 4 # drawn so many times as large, for smooth edges once they are reduced
FROM = (3, -6, 3)

simple.LoadPlugin(os.environ["LAMELLA_PLUGIN"], remote=False, ns=globals())
here = os.path.dirname(os.path.abspath(__file__))
for name in sorted(os.listdir(sys.argv[1])):
    folder = os.path.join(sys.argv[1], name)
    if not os.path.isdir(folder):
        continue
    run = VesicleRun(FileName=folder)
    run.UpdatePipelineInformation()
    view = simple.CreateView("RenderView")
    view.ViewSize, view.ViewTime = (SIZE * FINER, SIZE * FINER), run.TimestepValues[-1]
    view.OrientationAxesVisibility = 0
    simple.Show(run, view)
    boundary = simple.Show(simple.OutputPort(run, 1), view)
    boundary.LineWidth = 10
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = FROM, (0, 0, 0), (0, 0, 1)
    simple.ResetCamera(view)
    simple.SaveScreenshot(os.path.join(here, name + ".png"), view, TransparentBackground=1)
    simple.Delete(view)
    simple.Delete(run)
