# SPDX-License-Identifier: GPL-2.0-or-later
"""The canonical map, NetCDF in contact.engineering's layout, and a picture of it."""
import numpy as np


def write_map(path, channel, facts):
    """Write heights(x, y) in metres, nan where nothing was measured, and facts as attributes."""
    from scipy.io import netcdf_file

    ny, nx = channel.values.shape
    with netcdf_file(path, "w", version=2) as file:
        for name, value in facts.items():
            setattr(file, name, str(value).encode())
        for axis, n, length in (("x", nx, channel.size[0]), ("y", ny, channel.size[1])):
            file.createDimension(axis, n)
            coordinate = file.createVariable(axis, "d", (axis,))
            coordinate.length = np.float64(length)   # scipy stores a plain float in 32 bits
            coordinate.unit = b"m"
            coordinate.periodic = np.int32(channel.periodic)
            coordinate[:] = np.arange(n) * length / n
        heights = file.createVariable("heights", "d", ("x", "y"))
        heights.unit = b"m"
        heights[:] = np.where(np.isfinite(channel.values), channel.values * channel.metres,
                              np.nan).T


def statistics(channel):
    """Rms height about the mean and rms slope of measured points, and number of missing ones."""
    heights = np.where(np.isfinite(channel.values), channel.values * channel.metres, np.nan)
    ny, nx = heights.shape
    slopes = [np.diff(heights, axis=axis) / spacing
              for axis, spacing in ((1, channel.size[0] / nx), (0, channel.size[1] / ny))]
    means = [np.nanmean(slope**2) for slope in slopes if np.isfinite(slope).any()]
    return (float(np.nanstd(heights)), float(np.sqrt(sum(means))),
            int(heights.size - np.isfinite(heights).sum()))


def _spectrum(heights, size):
    """Wave numbers in 1/m and mean power of the rows, whose tilt is removed, tapered."""
    ny, nx = heights.shape
    y, x = np.mgrid[0:ny, 0:nx]
    plane = np.stack([np.ones(heights.size), x.ravel() / nx, y.ravel() / ny], axis=1)
    flat = heights - (plane @ np.linalg.lstsq(plane, heights.ravel(), rcond=None)[0]).reshape(
        ny, nx)
    waves = np.abs(np.fft.rfft(flat * np.hanning(nx), axis=1))**2
    power = waves.mean(axis=0) * size[0] / nx**2 * 8 / 3
    return 2 * np.pi * np.arange(1, nx // 2) / size[0], power[1:nx // 2]


def draw(path, channel):
    """Draw the map, a histogram of the heights, and the spectrum along x."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    heights = np.where(np.isfinite(channel.values), channel.values * channel.metres, np.nan)
    heights = heights - np.nanmean(heights)
    thin = max(1, max(heights.shape) // 1000)
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), constrained_layout=True)
    low, high = np.nanpercentile(heights * 1e6, [.5, 99.5])
    picture = axes[0].imshow(heights[::thin, ::thin] * 1e6, origin="lower", vmin=low, vmax=high,
                             extent=(0, channel.size[0] * 1e6, 0, channel.size[1] * 1e6))
    axes[0].set(xlabel="x (µm)", ylabel="y (µm)", title=channel.name or "heights")
    axes[0].get_images()[0].cmap.set_bad("red")
    figure.colorbar(picture, ax=axes[0], label="height (µm)")
    axes[1].hist(heights[np.isfinite(heights)] * 1e6, bins=100)
    axes[1].set(xlabel="height above the mean (µm)", ylabel="points", yscale="log")
    q, power = _spectrum(np.where(np.isfinite(heights), heights, 0.), channel.size)
    if len(q) > 1 and power.max() > 0:
        axes[2].loglog(q, np.maximum(power, power.max() * 1e-16))
    axes[2].set(xlabel="q (1/m)", ylabel="spectrum of the profiles along x (m³)")
    figure.savefig(path, dpi=100, format="png")
    plt.close(figure)
