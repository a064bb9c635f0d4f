# SPDX-License-Identifier: BSD-2-Clause
"""bench/peers.py and bench/sizes.py as a whole, with the real renderer on tiny scenes."""
import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from bench import peers, sizes
from bench.peer_scenes import SCENES, V3, V4, depth_across, puff

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ["PBRT_MEDIA_BIN"])
PBRT = str(BIN / "pbrt")


def rows_of(script, *options):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "rows.csv"
        done = subprocess.run([sys.executable, str(ROOT / "bench" / script), *options, "-o", str(out)], capture_output=True, text=True, timeout=250)
        if done.returncode != 0:
            return done, []
        with out.open(newline="") as file:
            return done, list(csv.DictReader(file))


class Errors(unittest.TestCase):
    def test_noise_of_the_reference_is_taken_off(self):
        chance = np.random.default_rng(1)
        image, reference = chance.normal(2, 0.3, (200, 100, 3)), chance.normal(2, 0.1, (200, 100, 3))
        found = peers.errors(image, reference, np.full_like(image, 0.01))
        self.assertAlmostEqual(found["error"], 0.09, delta=5 * 0.1 * np.sqrt(2 / image.size))
        self.assertGreater(peers.errors(image, reference, np.zeros_like(image))["error"], 0.095)

    def test_one_bright_pixel_is_in_the_mean_alone(self):
        image = np.full((50, 100, 3), 0.1)
        image[3, 4] = 100
        found = peers.errors(image, np.zeros_like(image), np.zeros_like(image))
        self.assertAlmostEqual(found["error"], 0.01 + (1e4 - 0.01) / 5000)
        self.assertAlmostEqual(found["usual_error"], 0.01)
        self.assertAlmostEqual(found["median_error"], 0.01)


class Scenes(unittest.TestCase):
    def test_volumes_are_as_empty_and_deep_as_told(self):
        field = puff(48, 4, 0.92, 7)
        self.assertAlmostEqual((field == 0).mean(), 0.92, delta=0.01)
        self.assertEqual((field.min(), field.max()), (0, 1))
        block = np.zeros((4, 10, 4))
        block[1, 2:7, 1] = 3
        self.assertAlmostEqual(depth_across(block), 3.0)  # half of the box, 2 units wide, of density 3

    def test_words_of_one_language_are_not_in_the_other(self):
        for name, make in SCENES.items():
            v3, v4 = make(V3, 8, 24), make(V4, 8, 24)
            for word in ("point3", "interface", "uniformgrid", "diffuse", "xradius"):
                self.assertNotIn(word, v3, name)
            for word in ("WorldEnd", '"point ', '"matte"', '"heterogeneous"', "xwidth"):
                self.assertNotIn(word, v4, name)


class Peers(unittest.TestCase):
    def test_the_same_program_is_as_good_and_half_the_samples_are_worse(self):
        command = f"{PBRT} --nthreads 1 --quiet --seed {{seed}} --outfile {{image}} {{scene}}"
        done, rows = rows_of("peers.py", PBRT, "--quick", "--rounds", "3", "--spp", "8", "--peer", f"same=v3={command}", "--peer", f"fewer=v3={command} --spp 2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([(r["scene"], r["program"]) for r in rows], [(s, p) for s in SCENES for p in (peers.OURS, "same", "fewer")])
        for own, same, fewer in zip(rows[0::3], rows[1::3], rows[2::3]):
            self.assertEqual(own["error"], "1.000")
            self.assertEqual(same["mean"], "1.0000", "the samples of the scene are those of --spp")
            self.assertAlmostEqual(float(same["error"]) / float(same["seconds"]), 1, delta=0.01)
            self.assertGreater(float(fewer["error"]) / float(fewer["seconds"]), 1.5)

    def test_a_peer_that_fails_is_named(self):
        done, _ = rows_of("peers.py", PBRT, "--quick", "--rounds", "1", "--scenes", "fog", "--peer", f"none=v4={PBRT} --no-such-option {{scene}} {{image}}")
        self.assertEqual(done.returncode, 1)
        self.assertIn("--no-such-option", done.stderr)


class Sizes(unittest.TestCase):
    def test_a_ball_is_closed_and_faces_outward(self):
        points, triangles = sizes.ball(1000)
        edges = {}
        for t in triangles.tolist():
            for edge in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
                edges[edge] = edges.get(edge, 0) + 1
        self.assertTrue(all(count == 1 and (b, a) in edges for (a, b), count in edges.items()))
        a, b, c = (points[triangles[:, i]] for i in range(3))
        self.assertAlmostEqual(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6, 4 / 3 * np.pi, delta=0.1)
        self.assertLess(abs(len(triangles) - 1000), 100)

    def test_each_kind_is_measured(self):
        kinds = ["triangles", "lights", "instances", "threads-fog"] + (["voxels"] if (BIN / "vdb2pbrt").is_file() else [])
        done, rows = rows_of("sizes.py", str(BIN), "--quick", "--rounds", "1", "--spp", "1", "--kinds", ",".join(kinds))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(list(dict.fromkeys(r["kind"] for r in rows)), kinds)
        for kind in set(kinds) & set(sizes.KINDS):
            self.assertEqual([int(r["size"]) for r in rows if r["kind"] == kind], list(sizes.KINDS[kind][1][:2]))
        for row in rows:
            self.assertTrue(all(float(row[n]) > 0 for n in sizes.NUMBERS), row)
