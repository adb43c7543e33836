#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Read the fields of a run back as ParaView does.

    check_paraview.py PROGRAM MPIRUN RANKS FOLDER

VTK reads flow-STEP.pvtu. Debian's VTK has no reader for fields-STEP.xmf: its XML is parsed,
and the data sets that it names are read from the HDF5 file. Both must agree with each other
and with leakage.csv. Status 77 (a skipped test) where python3-vtk9 or python3-h5py is not
installed.
"""
import csv
import shutil
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader
except ImportError as missing:
    print(f"The Python module {missing.name} is not installed: the fields are not read back")
    sys.exit(77)

LX, LY, NX, NY = 2., 1., 64, 32
INLET, OUTLET = 3., 1.  # pressures
SCENE = f"""
subsection Surface
  set Size                     = {LX}, {LY}
  set Short cut-off wavelength = 0.25
end
subsection Contact
  set Grid points = {NX}, {NY}
end
subsection Fluid
  set Inlet pressure  = {INLET}
  set Outlet pressure = {OUTLET}
  # Coarser cells at the rim of the contact overshoot by some parts in a thousand.
  set Target accuracy = 0.005
end
subsection Load programme
  set Pressures = 0.02, 0.05, 0.6
end
subsection Output
  set Fields   = all
  set Pictures = false
end
"""
CELL_ARRAYS = {"mean_conductivity", "level", "leaks"}
VTK_QUAD = 9


def check(condition, complaint):
    if not condition:
        sys.exit(f"FAILED: {complaint}")


def same(a, b):
    return np.allclose(a, b, rtol=1e-12, atol=1e-12 * max(LX, LY))


def read_flow(folder, step):
    """The corners of the cells, one row a cell, and the values of all arrays there."""
    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(folder / f"flow-{step}.pvtu"))
    reader.Update()
    grid = reader.GetOutput()
    n_cells = grid.GetNumberOfCells()
    check(n_cells > 0, f"flow-{step}.pvtu has no cells")
    check(set(vtk_to_numpy(grid.GetCellTypesArray())) == {VTK_QUAD}, "cells are no squares")
    arrays = {}
    data = grid.GetPointData()
    for k in range(data.GetNumberOfArrays()):
        arrays[data.GetArrayName(k)] = vtk_to_numpy(data.GetArray(k))
    check(set(arrays) == CELL_ARRAYS | {"fluid_pressure"}, f"the arrays are {set(arrays)}")
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(n_cells, 4)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return points[corners], {name: values[corners] for name, values in arrays.items()}


def check_flow(folder, row):
    points, arrays = read_flow(folder, row["step"])
    check(len(points) == int(row["cells"]),
          f"{len(points)} cells, leakage.csv has {row['cells']}")
    check(same(points.min((0, 1)), 0) and same(points.max((0, 1)), [LX, LY, 0]),
          "the mesh is not the box")
    sides = points.max(1) - points.min(1)
    check(same((sides[:, 0] * sides[:, 1]).sum(), LX * LY), "the cells do not fill the box")
    for name in CELL_ARRAYS:
        check((np.ptp(arrays[name], 1) == 0).all(), f"{name} varies within a cell")
    level, leaks = arrays["level"][:, 0], arrays["leaks"][:, 0] == 1
    check((np.diff(sides[np.argsort(level), 0]) <= 1e-6 * LX).all(), "levels are no sizes")
    check(leaks.any(), "nothing leaks")
    check((arrays["mean_conductivity"][leaks] > 0).all(), "a cell leaks without conductivity")
    pressure = arrays["fluid_pressure"][leaks]
    # Where almost nothing flows, the elements do not satisfy the maximum principle.
    conductivity = arrays["mean_conductivity"][leaks, 0]
    channel = pressure[conductivity > 1e-4 * conductivity.max()]
    margin = 1e-6 * (INLET - OUTLET)
    check(channel.min() >= OUTLET - margin and channel.max() <= INLET + margin,
          f"the pressure lies between {channel.min()} and {channel.max()}")
    check(np.abs(pressure - .5 * (INLET + OUTLET)).max() < INLET - OUTLET, "wild pressures")
    for x, expected in ((0., INLET), (LX, OUTLET)):
        at_end = pressure[np.abs(points[leaks][:, :, 0] - x) < 1e-9]
        check(len(at_end) and np.allclose(at_end, expected, rtol=1e-6),
              f"at x = {x} the pressure is not {expected}")
    # The flux along x, summed over all cells, is Q Lx but for the variation of K in them.
    drop = np.empty(len(pressure))
    for k, (corners, values) in enumerate(zip(points[leaks], pressure)):
        right = corners[:, 0] > corners[:, 0].mean()
        drop[k] = values[~right].mean() - values[right].mean()
    rate = (conductivity * drop * sides[leaks, 1]).sum() / LX
    check(abs(rate / float(row["leak_rate"]) - 1) < .1, f"the flux of the cells is {rate}, "
          f"the leak rate {row['leak_rate']}")
    return leaks, points


def numbers(text):
    return [float(word) for word in text.split()]


def check_grid(folder, row):
    """Check the data sets of fields-STEP.h5 that fields-STEP.xmf names, and return them."""
    step = row["step"]
    root = xml.etree.ElementTree.parse(folder / f"fields-{step}.xmf").getroot()
    check(root.tag == "Xdmf" and root.get("Version") == "2.0", "no XDMF of version 2")
    grid = root.find("Domain/Grid")
    check(grid.find("Topology").get("TopologyType") == "3DCoRectMesh", "another topology")
    check(grid.find("Topology").get("Dimensions") == f"1 {NY} {NX}", "another shape")
    origin, spacing = (numbers(item.text) for item in grid.findall("Geometry/DataItem"))
    check(origin == [0, 0, 0] and same(spacing[1:], [LY / NY, LX / NX]), "another lattice")
    fields = {}
    for attribute in grid.findall("Attribute"):
        check(attribute.get("Center") == "Node", "fields are at points")
        item = attribute.find("DataItem")
        name, path = item.text.split(":")
        check(name == f"fields-{step}.h5", f"the data are in {name}")
        with h5py.File(folder / name, "r") as file:
            values = file[path][()]
        kind = {"f": "Float", "i": "Int"}[values.dtype.kind]
        check(item.get("NumberType") == kind and
              int(item.get("Precision")) == values.dtype.itemsize, f"{path} has another type")
        check(values.size == np.prod([int(n) for n in item.get("Dimensions").split()]),
              f"{path} has another size")
        fields[attribute.get("Name")] = values
    check(set(fields) == {"gap", "pressure", "labels"}, f"the fields are {set(fields)}")
    check((fields["gap"] >= 0).all() and (fields["pressure"] >= 0).all(), "negative values")
    check(abs(np.mean(fields["gap"] == 0) - float(row["contact_area"])) < 1e-9, "contact area")
    check(np.isclose(fields["gap"].mean(), float(row["mean_gap"])), "mean gap")
    check(np.isclose(fields["pressure"].mean(), float(row["pressure"])), "nominal pressure")
    check((fields["labels"] == 4).any() == (row["percolates"] == "1"), "clusters")
    return fields


def main():
    program, mpirun, ranks, folder = sys.argv[1:]
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "scene.prm").write_text(SCENE, "utf-8")
    subprocess.run([mpirun, "-np", ranks, program, "scene.prm", "--quiet", "--output", "."],
                   cwd=folder, check=True)
    with open(folder / "leakage.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    check([row["percolates"] for row in rows] == ["1", "1", "0"], "two of three steps leak")
    for row in rows:
        fields = check_grid(folder, row)
        if row["percolates"] == "0":
            check(not (folder / f"flow-{row['step']}.pvtu").exists(), "a flow in no channel")
            continue
        leaks, points = check_flow(folder, row)
        # Of a grid cell with a leaking cell in it, a corner is in the channel.
        in_channel = fields["labels"] == 4
        small = leaks & (np.ptp(points[:, :, 0], axis=1) <= LX / NX * 1.001)
        centres = points[small].mean(1)
        ix, iy = (centres[:, :2] / [LX / NX, LY / NY]).astype(int).T
        corners = [in_channel[(iy + j) % NY, (ix + i) % NX] for i in (0, 1) for j in (0, 1)]
        check(small.any() and np.any(corners, axis=0).all(), "cells leak beside the channel")
    series = xml.etree.ElementTree.parse(folder / "flow.pvd").getroot().iter("DataSet")
    check([(float(entry.get("timestep")), entry.get("file")) for entry in series] ==
          [(1., "flow-1.pvtu"), (2., "flow-2.pvtu")], "the series is not that of the steps")
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
