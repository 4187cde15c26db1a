"""Relaxes a closed mesh from a file and writes the result beside it.

    python3 relax_mesh.py cell.stl          writes cell_relaxed.vtp

Any closed surface (STL, PLY, OBJ, VTP) is scaled into the box and moves under its bending energy, with
its volume and area kept.
"""
import sys
from pathlib import Path

import lamella
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

READERS = {".stl": vtkSTLReader, ".obj": vtkOBJReader, ".ply": vtkPLYReader,
           ".vtp": vtkXMLPolyDataReader}

path = Path(sys.argv[1])
reader = READERS[path.suffix.lower()]()
reader.SetFileName(str(path))

start = lamella.vtkVesicleFromSurface()
start.SetInputConnection(reader.GetOutputPort())
start.SetNodes(32, 32, 32)
start.ScaleToBoxOn()

dynamics = lamella.vtkVesicleDynamics()
dynamics.SetInputConnection(start.GetOutputPort())
dynamics.SetEndTime(1e-4)

for time in (0, 1e-4):
    frame = lamella.Frame(lamella.update(dynamics, time).GetOutput())
    print(f"t = {frame.time:g}: energy {frame.measures['energy']:.4f}, "
          f"reduced volume {frame.measures['v']:.5f}")

writer = vtkXMLPolyDataWriter()
writer.SetInputData(frame.surface())
writer.SetFileName(str(path.with_name(path.stem + "_relaxed.vtp")))
writer.Write()
