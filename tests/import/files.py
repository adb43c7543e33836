# SPDX-License-Identifier: GPL-2.0-or-later
"""One map of 12 x 10 points in files of every kind, as instruments and programs write them."""
import bz2
import gzip
import io
import lzma
import os
import struct
import zipfile

import numpy as np

NX, NY = 12, 10
SIZE = 24e-6, 10e-6            # m
Y, X = np.mgrid[0:NY, 0:NX]
# Micrometres with one digit after the point, no row or column of equal steps, no symmetry.
MICRONS = np.round(.8 + 2 * np.sin(.9 * X + .4 * Y**1.5) + .1 * Y, 1)
HOLE = 3, 4                    # row and column of the missing point in some files


def rows(separator, decimal="."):
    return "".join(separator.join(f"{value:.1f}".replace(".", decimal) for value in row) + "\n"
                   for row in MICRONS)


def points(separator, decimal=".", order=1):
    lines = [separator.join(f"{value:.1f}".replace(".", decimal)
                            for value in (2 * x, y, MICRONS[y, x]))
             for y in range(NY) for x in range(NX)]
    return "\n".join(lines[::order]) + "\n"


def points_in_order(separator, order):
    return "".join(separator.join(str({"x": 2 * x, "y": y, "z": MICRONS[y, x]}[name])
                                  for name in order) + "\n"
                   for y in range(NY) for x in range(NX))


def gwyddion_header(channel, width, height, unit, decimal="."):
    return (f"# {channel}: Z\n# {width}: 24{decimal}00 µm\n# {height}: 10{decimal}00 µm\n"
            f"# {unit}: µm\n")


SPIP = ("# File Format = ASCII\n# Created by SPIP 4.6.5.0 2008-02-20 11:56\n# x-pixels = 12\n"
        "# y-pixels = 10\n# x-length = 24000\n# y-length = 10000\n# x-unit = nm\n# y-unit = nm\n"
        "# Bit2nm = 1000\n# Start of Data:\n")
KEYENCE = ('"Date","01/02/2024"\n"Measurement data"\n"Pixel size","2","um"\n'
           '"X pixel size","2","um"\n"Y pixel size","1","um"\n"Unit","um"\n\n"Height"\n')


def axes(separator, corner):
    lines = [separator.join([corner] + [f"{2. * x}" for x in range(NX)])]
    lines += [separator.join([f"{1. * y}"] + [f"{value:.1f}" for value in MICRONS[y]])
              for y in range(NY)]
    return "\n".join(lines) + "\n"


def x_axis():
    return "\t".join(f"{2. * x}" for x in range(NX)) + "\n" + rows("\t")


def rounded_axes(with_y):
    """Axes with steps of 0.31, printed to one digit."""
    lines = [" ".join([".0"] * with_y + [f"{.31 * x:.1f}" for x in range(NX)])]
    lines += [" ".join([f"{.31 * y:.1f}"] * with_y + [row])
              for y, row in enumerate(rows(" ").splitlines())]
    return "\n".join(lines) + "\n"


def quoted(text, separator=","):
    return "".join(",".join(f'"{word}"' for word in line.split(separator)) + "\n"
                   for line in text.splitlines())


SIDES = "Width: 24 um\nHeight: 10 um\n"
SIDES_AND_UNIT = SIDES + "z unit: um\n"
# Texts that state everything: name, text.
COMPLETE = {
    "gwyddion.txt": gwyddion_header("Channel", "Width", "Height", "Value units") + rows("\t"),
    "gwyddion_german.txt": gwyddion_header("Kanal", "Breite", "Höhe", "Value units")
    + rows("\t"),
    "gwyddion_german_commas.txt": gwyddion_header("Kanal", "Breite", "Höhe", "Werteinheiten", ",")
    + rows("\t", ","),
    "gwyddion_french.txt": gwyddion_header("Canal", "Largeur", "Hauteur", "Unités de valeur")
    + rows("\t"),
    "gwyddion_russian.txt": gwyddion_header("Канал", "Ширина", "Высота", "Единицы") + rows(" "),
    "gwyddion_klingon.txt": gwyddion_header("Qap", "juch", "'ab", "mI'") + rows(" "),
    "spip.asc": SPIP + rows("\t"),
    "spip_column.asc": SPIP + rows("\n").replace("\n\n", "\n"),
    "keyence.csv": KEYENCE + rows(","),
    "keyence_quoted.csv": KEYENCE + quoted(rows(",")),
    "keyence_quoted_commas.csv": KEYENCE + quoted(rows(";", ","), ";"),
    "minus.txt": gwyddion_header("Channel", "Width", "Height", "Value units")
    + rows("\t").replace("-", "\u2212"),
    "interferometer.txt": "h=10 w=12\nx pixel size=2e-06 m\ny pixel size=1e-6 m\n"
                          "height conversion factor (-> m)=1e-06\n" + rows(" "),
    "semicolons.csv": "Width;24;µm\nHeight;10;µm\nUnit;µm\n" + rows(";", ","),
    "points.xyz": "# xy unit: um\n# z unit: um\n" + points(" "),
    "points.txt": "X [µm]\tY [µm]\tZ [µm]\n" + points("\t"),
    "points.csv": "X (um),Y (um),Z (um)\n" + points(","),
    "points_of_two_units.csv": "X (mm),Y (um),Z (um)\n" + "".join(
        f"{2e-3 * x:.3f},{y},{MICRONS[y, x]:.1f}\n" for x in range(NX) for y in range(NY)),
    "points_commas.csv": "X (um);Y (um);Z (um)\n" + points(";", ","),
    "points_shuffled.txt": "x [um] y [um] z [um]\n".replace(" [", "[") + "\n".join(
        sorted(points(" ").splitlines(), key=lambda line: line[::-1])) + "\n",
    "points_with_sides.txt": "# x size: 24 um\n# y size: 10 um\n# xy unit: um\n# z unit: um\n"
    + points(" "),
    "points_below_gwyddion.txt": gwyddion_header("Channel", "Width", "Height", "Value units")
    + points(" "),
    "points_named_below_sides.csv": SIDES + "X (um),Y (um),Z (um)\n" + points(","),
    "points_y_first.csv": "Y [um],X [um],Z [um]\n" + points_in_order(",", "yxz"),
    "points_z_first.csv": "Z [um],X [um],Y [um]\n" + points_in_order(",", "zxy"),
    "points_y_first.txt": "# Y (um) X (um) Z (um)\n" + points_in_order(" ", "yxz"),
    "points_position_y_first.csv": "Pos. Y (um),Pos. X (um),Height (um)\n"
                                   + points_in_order(",", "yxz"),
    "points_iy_first.csv": "iy [um],ix [um],height [um]\n" + points_in_order(",", "yxz"),
    "points_rows.csv": "Row (um),Col (um),Height (um)\n" + points_in_order(",", "yxz"),
    "points_rows.txt": "# xy unit: um\n# z unit: um\n# row column height\n"
                       + points_in_order(" ", "yxz"),
    "axes.txt": "# xy unit: um\n# z unit: um\n" + axes("\t", "y/x"),
    "axes_spacing.txt": "x spacing: 2 um\ny spacing: 1 um\nz unit: um\n" + axes("\t", "y/x"),
    "spip_two_units.asc": SPIP.replace("x-length = 24000", "x-length = 24").replace(
        "x-unit = nm", "x-unit = um") + rows("\t"),
    "unit_of_its_own.txt": "Width: 24 um\nHeight: 10 um\nUnit: um\n" + rows(" ") + "Unit: V\n"
                           + rows(" "),
    "scale_of_one.txt": "Width: 24 um\nHeight: 10 um\nUnit: um\nz scale = 1.0\n" + rows(" "),
    "side_of_all_steps.txt": SIDES_AND_UNIT + "dx: 2 um\ndy: 1 um\n" + rows(" "),
    "side_between_points.txt": "x size: 22 um\ny size: 9 um\nUnit: um\ndx: 2 um\ndy: 1 um\n"
                               + rows(" "),
    "stated_twice.txt": "Width: 24 um\nHeight: 10 um\nUnit: um\nHeight: 10000 nm\n" + rows(" "),
}

# Headers of as many lines as Gwyddion's, or one less, whose order means nothing: name, header.
NOT_OF_GWYDDION = {
    "height_first.txt": "# Height: 10 um\n# Width: 24 um\n# Value units: um\n",
    "steps.txt": "# dx: 2 um\n# dy: 1 um\n# unit: um\n",
    "named_steps.txt": "# Channel: Z\n# dx: 2 um\n# dy: 1 um\n# Value units: um\n",
    "one_offset.txt": "# Width: 24 um\n# Height: 10 um\n# X offset: 1 um\n# unit: um\n",
    "unnamed.txt": "# Height: 10 um\n# Width: 24 um\n# Comment: 3 um\n# Value units: um\n",
}
COMPLETE.update({name: header + rows(" ") for name, header in NOT_OF_GWYDDION.items()})

# Texts that lack something, or can be read in several ways: name, text, words of the refusal,
# and the options that decide.
IN_NM = ["--size", "24, 10 um", "--unit", "um"]
XY = ["--xy-unit", "um", "--unit", "um"]
TWICE = gwyddion_header("Channel", "Width", "Height", "Value units")
AMBIGUOUS = {
    "plain.txt": (rows(" "), "--size.*--unit", IN_NM),
    "plain.csv": (rows(","), "--size.*--unit", IN_NM),
    "plain_points.txt": (points(" "), "--xy-unit um --unit", XY),
    "plain_points.csv": (points(","), "--xy-unit um --unit", XY),
    "two_channels.txt": (TWICE + rows(" ") + TWICE.replace(": Z", ": back") + rows(" "),
                         "1: Z .*\n  2: back", ["--channel", "1"]),
    "two_blocks.txt": (rows(" ") + "\n" + rows(" "), "1: table 1 .*\n  2: table 2",
                       ["--channel", "table 2", *IN_NM]),
    "axis_row.txt": (x_axis(), "--as axes.*--as matrix", ["--as", "axes", *IN_NM]),
    "axes_number.txt": (axes(" ", "0"), "--as axes.*--as matrix", ["--as", "axes", *XY]),
    "offsets.txt": ("# X offset: 3 um\n# Y offset: 4 um\n# unit: um\n" + rows(" "),
                    "does not state its size", ["--size", "24, 10 um"]),
    "named_offsets.txt": ("# Channel: Z\n# X offset: 3 um\n# Y offset: 4 um\n# Value units: um\n"
                          + rows(" "), "does not state its size", ["--size", "24, 10 um"]),
    "tip.txt": ("# Sample: A\n# Tip radius: 10 nm\n# Thickness: 5 mm\n# unit: um\n" + rows(" "),
                "does not state its size", ["--size", "24, 10 um"]),
    "thousands.txt": ("\n".join(" ".join(f"{int(10 * abs(value)) + 1},500" for value in row)
                                for row in MICRONS), "--decimal comma or --decimal point", None),
    "sides_without_unit.txt": ("Width: 24\nHeight: 10\nUnit: um\n" + rows(" "),
                               "does not state its size", ["--xy-unit", "um"]),
    "amperes.txt": (TWICE.replace("units: µm", "units: A") + rows(" "), "'A', which is no length",
                    ["--unit", "um"]),
    "scale_in_one_word.txt": (SIDES + "Unit: um\nZScale=2\n" + rows(" "), "'zscale' as '2' .* --unit",
                              ["--unit", "um"]),
    "scale_of_counts.txt": (SIDES + "Height scale [nm/LSB]: 1\n" + rows(" "),
                            "'height scale .* as '1' .* --unit", ["--unit", "um"]),
    "volts.txt": (TWICE.replace("units: µm", "units: V") + rows(" "), "'V', which is no length",
                  ["--unit", "um"]),
    "axis_rounded.txt": (TWICE + rounded_axes(False), "--as axes.*--as matrix", ["--as", "axes"]),
    "axes_rounded.txt": (TWICE + rounded_axes(True), "--as axes.*--as matrix", ["--as", "axes"]),
    "decimal_comma_in_header.txt": (TWICE.replace("24.00", "24,000") + rows(" "),
                                    "'24,000 µm' .* --decimal comma", ["--decimal", "comma"]),
    "thousands_in_header.txt": (TWICE.replace("24.00 µ", "24,000 n") + rows(" "),
                                "'24,000 nm' .* --decimal point", ["--decimal", "point"]),
    "height_twice.txt": (SIDES + "Height: 120 nm\nz unit: um\n" + rows(" "),
                         "along y as '10 um' and as '120 nm' .* --size", ["--size", "24, 10 um"]),
    "spacing_twice.txt": ("dx: 2 um\nx spacing: 3 um\ndy: 1 um\nz unit: um\n" + rows(" "),
                          "along x as '2 um' and as '3 um' .* --size", ["--size", "24, 10 um"]),
    "unit_twice.txt": (SIDES + "Z unit: um\nUnit: mm\n" + rows(" "),
                       "heights as 'um' and as 'mm' .* --unit", ["--unit", "um"]),
    "side_and_step.txt": (SIDES + "z unit: um\ndx: 7 um\ndy: 1 um\n" + rows(" "),
                          "along x a side of 2.4e-05 m and 12 points in steps of 7e-06 m",
                          ["--size", "24, 10 um"]),
    "one_side_and_step.txt": ("Height: 40 um\npixel size: 2 um\nz unit: um\n" + rows(" "),
                              "along y a side of 4e-05 m and 10 points in steps of 2e-06 m",
                              ["--size", "24, 10 um"]),
    "step_and_axes.txt": ("x spacing: 2 um\ny spacing: 2 um\nxy unit: um\nz unit: um\n"
                          + axes("\t", "y/x"), "along y a side of 2e-05 m .* steps of 1e-06 m",
                          ["--size", "24, 10 um"]),
    "step_and_points.txt": ("pixel size: 2 um\nxy unit: um\nz unit: um\n" + points(" "),
                            "along y a side of 2e-05 m .* steps of 1e-06 m",
                            ["--size", "24, 10 um"]),
    "xy_unit_twice.txt": ("x unit: um\ny unit: mm\nz unit: um\n" + points(" "),
                          "coordinates as 'um' and as 'mm' .* --xy-unit", ["--xy-unit", "um"]),
    "scale.txt": (SIDES + "Unit: nm\nz scale = 1000\n" + rows(" "), "'z scale' as '1000' .* --unit",
                  ["--unit", "um"]),
    "scale_turned.txt": (SIDES + "Unit: um\nScale factor: -1\n" + rows(" "),
                         "'scale factor' as '-1' .* --unit", ["--unit", "um"]),
    "column_and_header.csv": ("Unit: mm\nX [um],Y [um],Z [um]\n" + points(","),
                              r"'Z \[um\]' .* --unit", ["--unit", "um"]),
    "column_of_volts.csv": ("Unit: um\nX [um],Y [um],Z [V]\n" + points(","),
                            r"'Z \[V\]' .* --unit", ["--unit", "um"]),
    "coordinate_and_header.csv": ("xy unit: mm\nX [um],Y [um],Z [um]\n" + points(","),
                                  r"'X \[um\]' .* --xy-unit", ["--xy-unit", "um"]),
}

# Texts that are no maps, or damaged.
REFUSED = {
    "profile.txt": ("\n".join(f"{x} {x * x % 7}" for x in range(20)), "profile"),
    "profile.csv": ("X_(microns),y1\n" + "\n".join(f"{x},{x * x % 7}" for x in range(20)),
                    "profile"),
    "profile_index.csv": ("index,x in µm,y in µm\n"
                          + "\n".join(f"{x},{x * .5},{x * x % 7}" for x in range(20)), "profile"),
    "profiles.txt": ("\n".join(f"{x} {x * x % 7} {x * x % 5} {x * x % 3}" for x in range(20)),
                     "grows by equal steps"),
    "list.txt": ("\n".join(str(x * x % 7) for x in range(20)), "profile"),
    "commas.txt": (TWICE + rows(", ", ","), "with a blank behind them"),
    "unequal.txt": (rows(" ") + "1 2 3\n", "3 values in line 11"),
    "word.txt": (rows(" ").replace(" ", " x", 1), "is no number"),
    "words.txt": ("This is no map.\n", "no table of numbers"),
    "underscore.txt": (TWICE + rows(" ").replace(".", "_.", 1), "is no number"),
    "length.txt": (TWICE.replace("24.00 µm", "24 furlongs") + rows(" "), "24 furlongs"),
    "promise.txt": ("h=11 w=12\npixel size=1 um\nUnit: um\n" + rows(" "), "promises 11 rows"),
    "columns.csv": ("X (um),a,b,c\n" + "\n".join(f"{x},{x * x % 7},{x % 3},{x % 2}"
                                                  for x in range(20)), "--as matrix"),
    "scattered.txt": ("\n".join(f"{x * x % 17} {x * x % 13}.5 {x}" for x in range(1, 40)),
                      "no x, y, z of points"),
}


def gwy_object(kind, components):
    content = b"".join(name.encode() + b"\0" + value for name, value in components)
    return kind.encode() + b"\0" + struct.pack("<I", len(content)) + content


def gwy():
    def unit(text):
        return b"o" + gwy_object("GwySIUnit", [("unitstr", b"s" + text.encode() + b"\0")])

    def field(values, z_unit):
        return b"o" + gwy_object("GwyDataField", [
            ("xres", b"i" + struct.pack("<i", NX)), ("yres", b"i" + struct.pack("<i", NY)),
            ("xreal", b"d" + struct.pack("<d", SIZE[0])),
            ("yreal", b"d" + struct.pack("<d", SIZE[1])),
            ("si_unit_xy", unit("m")), ("si_unit_z", unit(z_unit)),
            ("data", b"D" + struct.pack("<I", values.size) + values.astype("<f8").tobytes())])

    return b"GWYP" + gwy_object("GwyContainer", [
        ("/0/data", field(MICRONS * 1e-6, "m")), ("/0/data/title", b"sHeight\0"),
        ("/1/data", field(MICRONS, "V")), ("/1/data/title", b"sError\0")])


def x3p(folder="", hole=False):
    values = MICRONS.astype("<f8") * 1e-6
    if hole:
        values[HOLE] = np.inf
    axis = ("<C{0}><AxisType>{1}</AxisType><DataType>D</DataType><Increment>{2}</Increment>"
            "<Offset>0</Offset></C{0}>")
    xml = ("<?xml version='1.0' encoding='UTF-8'?><p:ISO5436_2 xmlns:p='http://www.opengps.eu/2008/"
           "ISO5436_2'><Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType>"
           "<Axes>" + axis.format("X", "I", 2e-6) + axis.format("Y", "I", 1e-6)
           + axis.format("Z", "A", 1)
           + f"</Axes></Record1><Record3><MatrixDimension><SizeX>{NX}</SizeX><SizeY>{NY}</SizeY>"
           "<SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>bindata/data.bin"
           "</PointDataLink></DataLink></Record3></p:ISO5436_2>")
    output = io.BytesIO()
    with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(folder + "main.xml", xml)
        archive.writestr(folder + "bindata/data.bin", values.tobytes())
    return output.getvalue()


def sdf():
    return (f"aISO-1.0\nManufacID = none\nCreateDate = 040120100853\nModDate = 050320101353\n"
            f"NumPoints = {NX}\nNumProfiles = {NY}\nXscale = 2.0e-6\nYscale = 1.0e-6\n"
            "Zscale = 1.0e-6\nZresolution = 1.0e-9\nCompression = 0\nDataType = 7\n"
            "CheckType = 0\n*\n" + rows(" ") + "*\n").encode()


def bcr(encoding="utf-16-le"):
    header = (f"fileformat = bcrf_unicode\nheadersize = 2048\nxpixels = {NX}\nypixels = {NY}\nxlength = 24000\n"
              "ylength = 10000\nxunit = nm\nyunit = nm\nzunit = nm\nbit2nm = 1\n"
              "intelmode = 1\n")
    if encoding == "latin-1":
        header = header.replace("bcrf_unicode", "bcrf")
    n_bytes = 4096 if encoding.startswith("utf-16") else 2048
    header = header.encode(encoding)
    return header + " ".encode(encoding) * ((n_bytes - len(header)) // len(" ".encode(encoding))) + (
        MICRONS * 1e3).astype("<f4").tobytes()


def write_arrays(folder):
    """Write files of arrays to a folder."""
    import h5py
    from scipy.io import savemat

    def path(name):
        return os.path.join(folder, name)

    np.save(path("array.npy"), MICRONS)
    np.savez(path("array.npz"), heights=MICRONS)
    savemat(path("array.mat"), {"heights": MICRONS, "other": np.zeros(3)})
    with h5py.File(path("attributes.h5"), "w") as file:
        data = file.create_dataset("scan/height", data=MICRONS, compression="gzip")
        data.attrs.update({"unit": "um", "lx": 24., "ly": 10., "lateral_unit": "um"})
        file["time"] = np.arange(5.)
    with h5py.File(path("two.h5"), "w") as file:
        file["first"], file["second"] = MICRONS, -MICRONS
    with h5py.File(path("netcdf4.nc"), "w") as file:
        heights = file.create_dataset("heights", data=MICRONS.T)
        heights.attrs["unit"] = "um"
        for i, (name, n, step) in enumerate((("x", NX, 2.), ("y", NY, 1.))):
            file[name] = np.arange(n) * step
            file[name].make_scale(name)
            file[name].attrs["unit"] = "um"
            heights.dims[i].attach_scale(file[name])
    write_netcdf(path("classic.nc"), 2. * np.arange(NX), 1. * np.arange(NY), MICRONS)
    # MATLAB 7.3 stores arrays by columns, after a header of its own.
    with h5py.File(path("matlab73.mat"), "w", userblock_size=512) as file:
        file["heights"], file["number"] = MICRONS.T, np.ones((1, 1))
    with open(path("matlab73.mat"), "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\0\2IM")


def write_netcdf(path, x, y, values, dtype="d", **attributes):
    """Write a classic file with heights(x, y); row 0 of the values is at y[0]."""
    from scipy.io import netcdf_file

    with netcdf_file(path, "w") as file:
        for name, along in (("x", x), ("y", y)):
            file.createDimension(name, len(along))
            side = file.createVariable(name, "d", (name,))
            side[:] = along
            side.unit = b"um"
        heights = file.createVariable("heights", dtype, ("x", "y"))
        heights[:] = values.T
        heights.unit = b"um"
        for name, value in attributes.items():
            setattr(heights, name, value)


def packed():
    """Text compressed or in another encoding: name, content."""
    text = COMPLETE["gwyddion_german.txt"].encode()
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("map.txt", text)
    return {"text.gz": gzip.compress(text), "text.bz2": bz2.compress(text),
            "text.xz": lzma.compress(text), "text.zip": archive.getvalue(),
            "utf16.txt": text.decode().encode("utf-16"),
            "latin1.txt": text.decode().encode("latin-1"),
            "crlf.txt": text.replace(b"\n", b"\r\n")}


def wyko(mult=1):
    """A text of Wyko's Vision: a line for each x, from the top, in wavelengths of 500 nm."""
    header = ("Wyko ASCII Data File Format 0\t0\t1\nX Size\t12\nY Size\t10\n"
              "Block Name\tType\tLength\tValue\nWavelength\t7\t4\t500\nAspect\t7\t4\t0.5\n"
              f"Pixel_size\t7\t4\t0.002\nMult\t7\t4\t{mult}\nRAW_DATA\t3\t480\t\n")
    return header + "".join("\t".join(f"{2 * value:.1f}" for value in column) + "\t\n"
                            for column in MICRONS[::-1].T)


NOVA = ("File Format = ASCII\r\nCreated by Nova\r\nFile: scan.mdt\r\nNX = 12\r\nNY = 10\r\n"
        "Scale X = 2\r\nScale Y = 1\r\nScale Data = 1\r\nBias X = 0\r\nBias Y = 0\r\n"
        "Bias Data = 0\r\nUnit X = um\r\nUnit Y = um\r\nUnit Data = um\r\n"
        "DataScaleNeeded = no\r\nStart of Data :\r\n")

# What Gwyddion reads: name, content.
THROUGH_GWYDDION = {"map.x3p": x3p(), "folder.x3p": x3p("scan/"), "ascii.sdf": sdf(),
                    "utf16.bcrf": bcr(), "plain.bcrf": bcr("latin-1"),
                    "wyko.asc": wyko(), "nova.txt": NOVA + rows("\t")}
