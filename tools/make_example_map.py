#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make prm/data/ground_surface.txt, the map of prm/measured_surface.prm.

    tools/make_example_map.py > prm/data/ground_surface.txt
    tools/make_example_map.py 512 > large.txt     # with this many points a side

Not a measurement: a periodic, self-affine surface (H = 0.8, wavelengths from 8 grid
spacings to the size of the map, of equal power above the roll-off wavelength of 64, rms
slope 0.1), as a matrix of heights in whole nanometres below a header with size and units. The map
is the same each time.
"""
import random
import sys

import numpy

POINTS = 128
SPACING = 1e-6  # m
NANOMETRE = 1e-9  # m
HURST = 0.8
RMS_SLOPE = 0.1
ROLL_OFF, SHORTEST = 64, 8  # wavelengths in grid spacings


def heights(points):
    """Heights in metres: a sum of waves with random phases."""
    phases = random.Random(1)
    spectrum = numpy.zeros((points, points), dtype=complex)
    roll_off, largest = points / ROLL_OFF, points / SHORTEST
    for ky in range(0, int(largest) + 1):
        for kx in range(-int(largest), int(largest) + 1):
            k = numpy.hypot(kx, ky)
            phase = phases.uniform(0., 2. * numpy.pi)
            if 1. <= k <= largest and (ky > 0 or kx > 0):
                amplitude = max(k, roll_off) ** -(1. + HURST)
                spectrum[ky, kx] = amplitude * numpy.exp(1j * phase)
    wave = 2. * numpy.pi * numpy.fft.fftfreq(points, SPACING)
    slopes = [numpy.fft.ifft2(1j * q * spectrum).real
              for q in (wave[numpy.newaxis, :], wave[:, numpy.newaxis])]
    rms_slope = numpy.sqrt(sum(numpy.mean(slope ** 2) for slope in slopes))
    return RMS_SLOPE / rms_slope * numpy.fft.ifft2(spectrum).real


def main():
    points = int(sys.argv[1]) if sys.argv[1:] else POINTS
    values = numpy.rint(heights(points) / NANOMETRE).astype(int)
    print(f"# Width: {points * SPACING:g} m")
    print(f"# Height: {points * SPACING:g} m")
    print("# Value units: nm")
    numpy.savetxt(sys.stdout, values - values.min(), fmt="%d")


if __name__ == "__main__":
    main()
