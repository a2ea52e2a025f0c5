"""The generated GLSL, run on Mesa, against the Rust f64 oracle.

Inputs are rounded to f32 first, so that the differences are those of the arithmetic alone.
"""

import csv
import io
import os
import subprocess
import unittest

import numpy as np

from support import ROOT, missing, report

# Bounds, about twice what was measured on llvmpipe; the directions' own rounding bounds what any f32 code can reach.
SINGLE_RELATIVE = 4e-5
SINGLE_FLOOR = 1e-6
LOSS_ISOTROPIC = 2e-3
LOSS_ANISOTROPIC = 5e-3
MULTIPLE_ISOTROPIC = 2e-3
MULTIPLE_ANISOTROPIC = 4e-3
MIN_ROUGHNESS = 0.002


def f32(values):
    return np.asarray(values, np.float32).astype(np.float64)


def catseye(verb, roughness, wo, wi):
    """Red: single scattering; green: its compensation."""
    command = os.environ.get("CATSEYE")
    table = io.StringIO()
    writer = csv.writer(table)
    axes = [f"{d}_{k}" for d in ("wo", "wi") for k in "xyz"]
    writer.writerow(["roughness_u", "roughness_v", *axes, "tint_r", "tint_g", "tint_b", "multiscatter_tint_r",
                     "multiscatter_tint_g", "multiscatter_tint_b"])
    for row in np.column_stack([roughness, wo, wi]):
        writer.writerow([repr(float(x)) for x in row] + [1, 0, 0, 0, 1, 0])
    done = subprocess.run([command, verb], input=table.getvalue(), capture_output=True, text=True, check=True)
    return np.genfromtxt(io.StringIO(done.stdout), delimiter=",", names=True)


class Values(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.reason = None
        if "CATSEYE" not in os.environ:
            cls.reason = "CATSEYE does not name the catseye command"
            return
        try:
            import gpu
            cls.gpu = gpu.Gpu()
        except Exception as error:  # noqa: BLE001 - no driver, no library: the reason is what counts
            cls.reason = f"no OpenGL: {error}"
            return
        report("values on", cls.gpu.name)

    def setUp(self):
        if self.reason:
            missing(self, self.reason)

    def compare(self, name, roughness, wo, wi):
        roughness, wo, wi = f32(roughness), f32(wo), f32(wi)
        found = self.gpu.bsdf(roughness, wo, wi)
        self.assertTrue(np.isfinite(found).all())
        exact = catseye("eval", roughness, wo, wi)
        single, multiple = exact["f_r"] * wi[:, 2], exact["f_g"] * wi[:, 2]
        loss = 1.0 - catseye("albedo", roughness, wo, wi)["albedo_r"]
        isotropic = roughness[:, 0] == roughness[:, 1]

        single_error = np.abs(found[:, 0] - single) / np.maximum(single, SINGLE_FLOOR)
        loss_error = np.maximum(np.abs(found[:, 2] - loss), np.abs(found[:, 3] - (1.0 - loss)))
        multiple_error = np.abs(found[:, 1] - multiple)
        greatest = lambda values, where: float(values[where].max()) if where.any() else 0.0
        report(f"{name}: {len(wo)} rows; single {single_error.max():.1e} relative;",
               f"loss {greatest(loss_error, isotropic):.1e} isotropic, {greatest(loss_error, ~isotropic):.1e} anisotropic;",
               f"compensation {greatest(multiple_error, isotropic):.1e}, {greatest(multiple_error, ~isotropic):.1e}")
        self.assertLess(single_error.max(), SINGLE_RELATIVE)
        self.assertLess(greatest(loss_error, isotropic), LOSS_ISOTROPIC)
        self.assertLess(greatest(loss_error, ~isotropic), LOSS_ANISOTROPIC)
        self.assertLess(greatest(multiple_error, isotropic), MULTIPLE_ISOTROPIC)
        self.assertLess(greatest(multiple_error, ~isotropic), MULTIPLE_ANISOTROPIC)

    def test_conformance_rows(self):
        rows = np.genfromtxt(ROOT / "conformance/reference_eval.csv", delimiter=",", names=True)
        vectors = {d: np.stack([rows[f"{d}_{k}"] for k in "xyz"], 1) for d in ("wo", "wi")}
        roughness = np.stack([rows["roughness_u"], rows["roughness_v"]], 1)
        kept = roughness.min(axis=1) >= MIN_ROUGHNESS
        report(f"conformance: {kept.sum()} of {len(kept)} rows are at least as rough as the minimum")
        self.compare("conformance", roughness[kept], vectors["wo"][kept], vectors["wi"][kept])

    def test_roughness_ends(self):
        """Around the retro direction and far from it, at every elevation down to half a degree."""
        random = np.random.default_rng(1)
        for r_u, r_v in [(0.005, 0.005), (1.0, 1.0), (5.0, 5.0), (0.002, 0.002), (0.005, 1.0), (5.0, 0.05)]:
            elevation = np.radians(random.choice([0.5, 1.0, 5.0, 30.0, 60.0, 85.0, 89.9], 1000))
            turn = random.uniform(0, 2 * np.pi, 1000)
            wo = np.stack([np.cos(elevation) * np.cos(turn), np.cos(elevation) * np.sin(turn), np.sin(elevation)], 1)
            near = random.normal(size=(1000, 3)) * r_u * 0.5 * wo[:, 2:]
            far = random.normal(size=(1000, 3))
            wi = np.where(random.random((1000, 1)) < 0.7, wo + near, far)
            wi /= np.linalg.norm(wi, axis=1, keepdims=True)
            wi[:, 2] = np.abs(wi[:, 2])
            self.compare(f"roughness {r_u}, {r_v}", np.tile([r_u, r_v], (1000, 1)), wo, wi)

    def test_degenerate_input_is_finite(self):
        """Roughness 0 is the minimum, -1 means "as roughness_u", horizons are black, both sides are alike."""
        up, low = np.array([[0.0, 0.0, 1.0]]), np.array([[1.0, 0.0, 0.0]])
        peak = self.gpu.bsdf(np.array([[0.0, -1.0]]), up, up)
        self.assertAlmostEqual(peak[0, 0] * np.pi * 4 / (2 / MIN_ROUGHNESS**2 + 1), 1.0, places=5)
        self.assertLess(peak[0, 0], 65504)
        for roughness in [(0, 0), (1, -1), (np.inf, np.inf), (np.nan, np.nan), (-5, -5), (1e20, 1e-20)]:
            for wo in (up, low, -up):
                for wi in (up, low, -up):
                    for tangent in (1.0, 0.0):
                        for closure in (0, 1, 2, 3):
                            found = self.gpu.bsdf(np.array([roughness]), wo, wi, closure, tangent=tangent)
                            self.assertTrue(np.isfinite(found).all(), (roughness, wo, wi, tangent, closure, found))
                            self.assertTrue((found >= 0).all())
        self.assertEqual(self.gpu.bsdf(np.array([[1.0, 1.0]]), up, -up)[0, 0], 0.0)
        both = [self.gpu.bsdf(np.array([[0.3, 0.1]]), sign * up, sign * up)[0] for sign in (1, -1)]
        np.testing.assert_array_equal(both[0], both[1])
        alias = [self.gpu.bsdf(np.array([[0.3, v]]), up, f32([[0.1, 0.2, 0.97]]))[0] for v in (-1.0, 0.3)]
        np.testing.assert_array_equal(alias[0], alias[1])


if __name__ == "__main__":
    unittest.main()
