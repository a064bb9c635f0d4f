# SPDX-License-Identifier: BSD-2-Clause
"""Test-case files are read as they are meant, and their mistakes are named."""
import tempfile
import unittest
from pathlib import Path

from compare.case import Case, load_case, quick, read_case
from compare.problems import CaseError


class ReadCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "s.pbrt").write_text("WorldBegin\nWorldEnd\n")

    def read(self, **content) -> Case:
        return read_case({"scene": [{"file": "s.pbrt"}], **content}, "t.toml", self.folder)

    def expect_problem(self, part: str, **content) -> None:
        with self.assertRaises(CaseError) as caught:
            self.read(**content)
        self.assertIn(part, str(caught.exception))
        self.assertTrue(str(caught.exception).startswith("t.toml"), caught.exception)

    def test_short_words_become_parameters_and_directives(self):
        case = self.read(setting=[{"name": "a", "transmittance": "ratio+roulettethreshold=0.3", "bounds": "constant", "sampler": "random",
                                   "medium": '"integer supervoxels" 4', "rewrite": 'Film "image" "float scale" 2'}])
        setting = case.settings[0]
        self.assertEqual(setting.medium, '"string transmittance" "ratio" "float roulettethreshold" 0.3 "string bounds" "constant" "integer supervoxels" 4')
        self.assertEqual(setting.rewrite, ('Sampler "random"', 'Film "image" "float scale" 2'))
        self.assertEqual(case.reference_setting, "a")

    def test_a_matrix_is_all_combinations_named_by_what_varies(self):
        case = self.read(matrix={"transmittance": ["ratio", "regular"], "freeflight": ["delta", "decomposition"], "sampler": ["halton"]})
        self.assertEqual([s.name for s in case.settings], ["ratio, delta", "ratio, decomposition", "regular, delta", "regular, decomposition"])
        self.assertTrue(all(s.rewrite == ('Sampler "halton"',) for s in case.settings))

    def test_budgets_of_scenes_are_their_own(self):
        case = self.read(budget=4, scene=[{"file": "s.pbrt"}, {"file": "s.pbrt", "name": "b", "budget": 2}], setting=[{"name": "a"}])
        self.assertEqual([s.budget for s in case.scenes], [4, 2])
        self.assertEqual([s.budget for s in quick(case).scenes], [0.5, 0.25])

    def test_a_setting_may_be_for_the_reference_only(self):
        case = self.read(setting=[{"name": "a"}, {"name": "r", "reference_only": True}], reference={"setting": "r"})
        self.assertEqual([s.name for s in case.compared()], ["a"])
        self.assertEqual(case.reference_maker().name, "r")

    def test_mistakes_are_named(self):
        one = [{"name": "a"}]
        self.expect_problem('unknown key "bugdet"; did you mean "budget"?', setting=one, bugdet=3)
        self.expect_problem('unknown equal "second"; did you mean "seconds"?', setting=one, equal="second")
        self.expect_problem("budget: expected a number of at least", setting=one, budget=-1)
        self.expect_problem("slices: expected int, found 2.5", setting=one, slices=2.5)
        self.expect_problem("repeats: expected a number of at least 2", setting=one, repeats=1)
        self.expect_problem("repeats: expected int, found True", setting=one, repeats=True)
        self.expect_problem("a setting needs a name", setting=[{}])
        self.expect_problem('two settings are named "a"', setting=one * 2)
        self.expect_problem("at least one scene and one setting", setting=[])
        self.expect_problem('unknown setting "b"', setting=one, reference={"setting": "b"})
        self.expect_problem("no scene", setting=one, scene=[{"file": "none.pbrt"}])
        self.expect_problem("no reference", setting=one, scene=[{"file": "s.pbrt", "reference": "none.exr"}])
        self.expect_problem('"times"', setting=one, reference={"tims": 3})
        self.expect_problem("takes no medium parameters", setting=[{"name": "a", "command": "x {scene}", "medium": '"float a" 1'}])

    def test_mistakes_in_rewritings_and_methods_are_named(self):
        with self.assertRaisesRegex(CaseError, "Translate cannot be rewritten"):
            self.read(setting=[{"name": "a", "rewrite": 'Translate "x" 1 2 3'}])
        with self.assertRaisesRegex(CaseError, r"expected NAME\+PARAMETER=NUMBER"):
            self.read(setting=[{"name": "a", "transmittance": "ratio+0.3"}])

    def test_toml_and_json_say_the_same(self):
        (self.folder / "c.toml").write_text('title = "t"\n[[scene]]\nfile = "s.pbrt"\n[[setting]]\nname = "a"\nbounds = "constant"\n')
        (self.folder / "c.json").write_text('{"title": "t", "scene": [{"file": "s.pbrt"}], "setting": [{"name": "a", "bounds": "constant"}]}')
        self.assertEqual(load_case(self.folder / "c.toml"), load_case(self.folder / "c.json"))
        (self.folder / "c.toml").write_text("budget = \n")
        with self.assertRaisesRegex(CaseError, "line 1"):
            load_case(self.folder / "c.toml")


if __name__ == "__main__":
    unittest.main()
