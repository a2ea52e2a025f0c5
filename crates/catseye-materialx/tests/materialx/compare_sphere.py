"""Compares two pictures of the sphere of direct_sphere.rs: `python compare_sphere.py THEIRS.exr OURS.exr`."""

import math
import sys

import numpy as np
import OpenEXR


def load(path):
    with OpenEXR.File(path) as file:
        channels = file.channels()
        pixels = channels["RGB" if "RGB" in channels else "RGBA"].pixels
    return np.asarray(pixels, np.float64)[..., :3]


def main(theirs, ours):
    a, b = load(theirs), load(ours)
    size = len(b)
    y, x = (np.mgrid[:size, :size] + 0.5) / size * 2 - 1
    # Without the edge, whose coverage is the renderers' matter.
    inside = np.hypot(x, y) < math.sqrt(1 / 24) / math.tan(math.radians(13)) - 6 / size
    error = math.sqrt(np.mean((a - b)[inside] ** 2) / np.mean(b[inside] ** 2))
    print(f"RMSE {error:.3f} of the RMS, mean {a[inside].mean() / b[inside].mean():.3f}, peak {a.max() / b.max():.3f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
