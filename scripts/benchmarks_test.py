#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""The tables of docs/benchmarks.md and docs/convergence.md must follow from recorded results."""
import json
import pathlib
import shutil
import tempfile
import unittest

import benchmarks


PAGE, CONVERGENCE = benchmarks.PAGES


class Benchmarks(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        shutil.copytree(benchmarks.ROOT / benchmarks.DATA, self.root / benchmarks.DATA)
        self.text = (benchmarks.ROOT / PAGE).read_text()

    def record(self, name: str, text: str) -> str:
        path = self.root / name
        path.write_text(text)
        benchmarks.record(self.root, path)
        return benchmarks.page(self.root, PAGE, self.text)

    def test_the_page_is_what_the_command_writes(self):
        self.assertEqual(benchmarks.page(self.root, PAGE, self.text), self.text)
        comparing = (benchmarks.ROOT / CONVERGENCE).read_text()
        self.assertEqual(benchmarks.page(self.root, CONVERGENCE, comparing), comparing)

    def test_a_typed_number_is_seen(self):
        row = next(line for line in self.text.splitlines() if line.startswith("| `regular`"))
        self.assertNotEqual(benchmarks.page(self.root, PAGE, self.text.replace(row, row.replace("1", "2"))),
                            self.text.replace(row, row.replace("1", "2")))

    def test_new_results_replace_theirs_and_no_others(self):
        report = {"environment": {"cpu": "Abacus", "simd": "beads", "compiler": "GNU", "flags": "-O3"},
                  "rows": [{"field": "grid-256", "estimator": "regular", "nsPerEstimate": 1234.4, "lookups": 5, "mse": 0}]}
        page = self.record("e.json", json.dumps(report))
        self.assertIn("| 1234 | 5.0 | 0 | exact |\n", page)
        self.assertIn("Measured by Abacus, batches on beads; GNU, -O3.\n", page)
        self.assertEqual(page.count("\n"), self.text.count("\n"))

    def test_work_is_relative_to_the_first_setting(self):
        page = self.record("summary.csv", "scene,setting,variance_x_samples,variance_x_lookups,variance_x_cpu\n"
                                          "smoke,ratio,2,8,5\nsmoke,mine,1,2,20\n")
        self.assertIn("| `ratio` | 1.00 | 1.00 | 1.00 |\n", page)
        self.assertIn("| `mine` | 0.50 | 0.25 | 4.00 |\n", page)

    def test_ways_tell_noise_times_time_of_all_but_what_they_are_relative_to(self):
        page = self.record("ways.csv", "scene,way,seconds,variance,usual_variance,median_variance\n"
                                       "fog,before,1.000,1.000,1.000,1.000\nfog,mine,0.500,0.800,1.200,2.000\n")
        self.assertIn("| mine | fog | 0.50 | 0.40 | 0.60 | 1.00 |\n", page)
        self.assertNotIn("| before |", page)

    def test_sizes_and_threads_are_rows_of_two_tables(self):
        page = self.record("sizes.csv", "kind,size,us_per_sample,elapsed_us_per_sample,first_pixel_seconds,megabytes\n"
                                        "lights,10,12.34,13,0.056,33.4\nthreads-fog,1,5,8,0.1,20\nthreads-fog,64,5,2,0.1,20\n")
        self.assertIn("| lights | 10 | 12.3 | 0.06 | 33 |\n", page)
        self.assertIn("| fog | 64 | 4.00 |\n", page)
        self.assertNotIn("threads-fog", page)
        self.assertNotIn("| fog | 1 |", page)

    def test_several_scenes_are_columns_and_bias_is_no_number(self):
        ends = "relative_cpu,relative_cpu_low,relative_cpu_high"
        path = self.root / "summary.csv"
        path.write_text(f"scene,setting,biased,{ends}\nfog,a,False,1,1,1\nfog,b,False,2.345,2,3\nfire,a,True,.5,.4,.6\nfire,b,False,1,1,1\n")
        (self.root / benchmarks.DATA / "comparison.csv").write_text("scene,setting\n")
        self.assertEqual(benchmarks.record(self.root, path), "comparison")
        page = benchmarks.page(self.root, CONVERGENCE, "<!-- table comparison -->\n<!-- end -->\n")
        self.assertIn("| setting | fog | fire |\n", page)
        self.assertIn("| `a` | **1** | biased |\n| `b` | 2.35 (2.00 – 3.00) | **1** |\n", page)


if __name__ == "__main__":
    unittest.main()
