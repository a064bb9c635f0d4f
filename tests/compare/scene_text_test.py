# SPDX-License-Identifier: BSD-2-Clause
"""Directives are found and changed as the renderer would read them."""
import gzip
import tempfile
import unittest
from pathlib import Path

from compare.problems import CaseError
from compare.scene_text import directives, files_of, rewrite, scene_hash

SCENE = """# Sampler "not this one"
Integrator "volpath" "integer maxdepth" [ 10 ]
Film "image" "integer xresolution" 400 # wide
  "string filename" "a#b.exr"
LookAt 0 1 2  3 4 5  0 0 1
WorldBegin
Include "medium.pbrt"
MediumInterface "fog" ""
Shape "sphere" "float radius" [ 2 ]
LightSource "point" "rgb I" [ 1 1 1 ]
WorldEnd
"""
MEDIUM = 'MakeNamedMedium "fog" "string type" "heterogeneous" "float density" [ 1 2\n3 4 ]\nMakeNamedMedium "ice" "string type" "homogeneous"\n'


class SceneText(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "medium.pbrt").write_text(MEDIUM)

    def test_directives_are_found_with_their_parameters(self):
        found = list(directives(SCENE))
        self.assertEqual([d.word for d in found], ["Integrator", "Film", "LookAt", "WorldBegin", "Include", "MediumInterface", "Shape", "LightSource",
                                                   "WorldEnd"])
        self.assertEqual([p.declaration for p in found[1].parameters], ["integer xresolution", "string filename"])
        self.assertEqual(found[1].parameters[1].values, '"a#b.exr"')
        self.assertEqual(found[5].parameters, [])

    def test_a_parameter_is_replaced_and_others_stay(self):
        text = rewrite(SCENE, ['Integrator "path" "integer maxdepth" 3 "float rrthreshold" [ .5 ]'], self.folder)
        self.assertIn('Integrator "path" "integer maxdepth" 3 "float rrthreshold" [ .5 ]', text)
        self.assertNotIn("[ 10 ]", text)
        text = rewrite(SCENE, ['Film "image" "integer xresolution" 8'], self.folder)
        self.assertIn('Film "image" "string filename" "a#b.exr" "integer xresolution" 8', text)

    def test_what_is_not_there_is_added_before_the_world(self):
        text = rewrite(SCENE, ['Sampler "halton"'], self.folder)
        self.assertIn('Sampler "halton"\nWorldBegin', text)
        self.assertIn("not this one", text)

    def test_included_media_are_changed_by_name(self):
        text = rewrite(SCENE, ['MakeNamedMedium "fog" "float scale" 2'], self.folder)
        self.assertNotIn("Include", text)
        self.assertIn('MakeNamedMedium "fog" "string type" "heterogeneous" "float density" [ 1 2\n3 4 ] "float scale" 2', text)
        self.assertEqual(text.count("scale"), 1)
        self.assertEqual(rewrite(SCENE, ['MakeNamedMedium "*" "float scale" 2'], self.folder).count("scale"), 2)

    def test_a_rewriting_that_meets_nothing_is_an_error(self):
        for line in ('MakeNamedMedium "fgo" "float scale" 2', 'Shape "disk" "float radius" 1', 'Translate 1 2 3', "", 'Integrator'):
            with self.assertRaises(CaseError):
                rewrite(SCENE, [line], self.folder)

    def test_files_count_in_the_hash(self):
        first = scene_hash(SCENE, self.folder)
        self.assertEqual(first, scene_hash(SCENE, self.folder))
        (self.folder / "medium.pbrt").write_text(MEDIUM + 'Texture "t" "spectrum" "imagemap" "string filename" "t.png"')
        second = scene_hash(SCENE, self.folder)
        (self.folder / "t.png").write_bytes(b"1")
        third = scene_hash(SCENE, self.folder)
        (self.folder / "t.png").write_bytes(b"2")
        self.assertEqual(len({first, second, third, scene_hash(SCENE, self.folder)}), 4)
        self.assertEqual([p.name for p in files_of(SCENE, self.folder)], ["medium.pbrt", "t.png"])

    def test_packed_includes_are_read(self):
        (self.folder / "m.pbrt.gz").write_bytes(gzip.compress(MEDIUM.encode()))
        text = rewrite(SCENE.replace("medium.pbrt", "m.pbrt.gz"), ['MakeNamedMedium "ice" "float scale" 2'], self.folder)
        self.assertIn('"ice" "string type" "homogeneous" "float scale" 2', text)


if __name__ == "__main__":
    unittest.main()
