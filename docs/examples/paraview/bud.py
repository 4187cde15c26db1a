"""A domain buds off, drawn without a display: a picture for each state, and one of the curvature at the end.

pvpython bud.py PLUGIN FOLDER, PLUGIN being .../paraview-5.11/plugins/Lamella/Lamella.so
"""

import os
import sys

from paraview.simple import *

plugin, folder = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
os.makedirs(folder, exist_ok=True)

vesicle = Vesicle(Shape="sphere", Radius=0.98, HalfWidth=1.96, Nodes=[48, 48, 48],
                  Domains="cap", AreaFraction=0.2, LineTension=30,
                  Volume="ramped", VolumeTargets=[0.9, 0], VolumeRate=100,  # target, when to set out for it
                  EndTime=3e-3, Frames=4)
vesicle.UpdatePipelineInformation()

view = CreateRenderView(ViewSize=[600, 600], OrientationAxesVisibility=0)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [3, -6, 3], [0, 0, 0], [0, 0, 1]
membrane = Show(vesicle, view)
Show(OutputPort(vesicle, 1), view)  # the phase boundary
for number, time in enumerate(vesicle.TimestepValues):
    view.ViewTime = time
    ResetCamera(view)
    SaveScreenshot(os.path.join(folder, f"bud_{number}.png"), view)

ColorBy(membrane, ("POINTS", "K_M"))
colors = GetColorTransferFunction("K_M")
colors.RescaleTransferFunction(-8, 8)
membrane.SetScalarBarVisibility(view, True)
SaveScreenshot(os.path.join(folder, "curvature.png"), view)

energy = servermanager.Fetch(vesicle, idx=2).GetColumnByName("energy")  # a row for each step so far
print(f"energy {energy.GetValue(0):.1f} -> {energy.GetValue(energy.GetNumberOfTuples() - 1):.1f}")
