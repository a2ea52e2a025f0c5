"""Light from an environment map, in every mode, against the integral of the f64 oracle's samples.

The map's radiance is a sum of waves: smooth, but with detail that a wrong direction or width shows. Its mean over a lobe
is found with the oracle's own sampling.
"""

import csv
import io
import os
import subprocess
import unittest

import numpy as np

from support import missing, report

SAMPLES = 1024
ORACLE_SAMPLES = 4096
# By mode and whether CATSEYE_RETRO_REFLECTIVE_FIS is defined: the greatest difference of the response, the map's
# greatest radiance being 1, and that of a white furnace from 1; about twice what was measured.
BOUNDS = {
    ("FIS", True): (0.005, 0.006),
    ("FIS", False): (0.08, 0.09),
    ("PREFILTER", False): (0.2, 0.09),
}


def directions(height=256):
    """The direction of each texel of MaterialX's lat-long map, turned as its default u_envMatrix turns it."""
    v, u = np.mgrid[:height, : 2 * height]
    latitude = ((v + 0.5) / height - 0.5) * np.pi
    longitude = ((u + 0.5) / (2 * height) - 0.5) * 2 * np.pi
    y, level = -np.sin(latitude), np.cos(latitude)
    return np.stack([-level * np.sin(longitude), y, level * np.cos(longitude)], -1)


def radiance(w):
    x, y, z = np.moveaxis(w, -1, 0)
    return np.stack([0.5 + 0.25 * (np.sin(6 * x + 1) + np.sin(5 * y - 2 * z))] * 3, -1)


def oracle(roughness, wo):
    """The mean of weight and radiance over the lobe's samples, for each row."""
    random = np.random.default_rng(3)
    table = io.StringIO()
    writer = csv.writer(table)
    writer.writerow(["roughness_u", "roughness_v", "wo_x", "wo_y", "wo_z", "u1", "u2", "u3"])
    for r, o in zip(roughness, wo, strict=True):
        i = (np.arange(ORACLE_SAMPLES) + random.random()) / ORACLE_SAMPLES
        j = (np.arange(ORACLE_SAMPLES) * 0.6180339887498949 + random.random()) % 1
        for u, v in zip(i, j, strict=True):
            writer.writerow([*map(repr, map(float, (*r, *o, v, u))), 0.5])
    done = subprocess.run([os.environ["CATSEYE"], "sample"], input=table.getvalue(), capture_output=True, text=True,
                          check=True)
    rows = np.genfromtxt(io.StringIO(done.stdout), delimiter=",", names=True, dtype=None, encoding="ascii")
    wi = np.stack([rows[f"wi_{k}"] for k in "xyz"], -1)
    return (rows["weight_r"][:, None] * radiance(wi)).reshape(len(wo), ORACLE_SAMPLES, 3).mean(axis=1)[:, 0]


class Environment(unittest.TestCase):
    def setUp(self):
        if "CATSEYE" not in os.environ:
            missing(self, "CATSEYE does not name the catseye command")
        try:
            import gpu
            self.module = gpu
            gpu.Gpu()
        except Exception as error:  # noqa: BLE001 - no driver, no library: the reason is what counts
            missing(self, f"no OpenGL: {error}")

    def test_response(self):
        gpu = self.module
        rows = [(r, theta, phi) for r in [(0.03, 0.03), (0.15, 0.15), (0.5, 0.5), (2.0, 2.0), (0.05, 0.5)]
                for theta in (0, 30, 60, 80) for phi in (20, 110)]
        roughness = np.array([r for r, _, _ in rows])
        theta, phi = np.radians([[t, p] for _, t, p in rows]).T
        wo = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], 1)
        exact = oracle(roughness, wo)
        white = np.ones((64, 128, 3))
        for (mode, own), (bound, furnace_bound) in BOUNDS.items():
            device = gpu.Gpu(mode, ["CATSEYE_RETRO_REFLECTIVE_FIS"] if own else [])
            device.environment(radiance(directions()), white, SAMPLES)
            found = device.bsdf(roughness, wo, wo, gpu.INDIRECT)
            error = np.abs(found[:, 0] - exact)
            device.environment(white, white, SAMPLES)
            furnace = device.bsdf(roughness, wo, wo, gpu.INDIRECT)
            albedo = np.abs(furnace[:, 0] - (1.0 - furnace[:, 2]))
            whole = np.abs(furnace[:, :2].sum(axis=1) - 1.0)
            name = f"{mode}, {'own lobe' if own else 'default'}"
            report(f"{name}: response within {error.max():.3f}, mean {error.mean():.4f};",
                   f"white furnace: albedo within {albedo.max():.4f}, both tints 1 within {whole.max():.4f}")
            self.assertLess(error.max(), bound, name)
            self.assertLess(whole.max(), furnace_bound, name)

    def test_none_is_black(self):
        device = self.module.Gpu("NONE")
        up = np.array([[0.0, 0.0, 1.0]])
        self.assertEqual(device.bsdf(np.array([[0.3, 0.3]]), up, up, self.module.INDIRECT)[0, :2].tolist(), [0.0, 0.0])


if __name__ == "__main__":
    unittest.main()
