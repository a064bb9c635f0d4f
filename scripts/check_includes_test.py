#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""The include check must find what it is there to find."""
import pathlib
import tempfile
import unittest

import check_includes

LICENCE = "// SPDX-License-Identifier: BSD-2-Clause\n"


class CheckIncludes(unittest.TestCase):
    def check(self, name: str, text: str) -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text(text)
            return check_includes.problems(pathlib.Path(folder))

    def test_accepts_an_include_that_points_down(self):
        self.assertEqual(self.check("media/a.cpp", LICENCE + '#include "fields/grid_field.h"\n'), [])

    def test_rejects_an_include_that_points_up(self):
        self.assertEqual(len(self.check("fields/a.cpp", LICENCE + '#include "media/medium.h"\n')), 1)

    def test_rejects_an_unnamed_peer(self):
        self.assertEqual(len(self.check("cameras/a.cpp", LICENCE + '#include "film/film.h"\n')), 1)

    def test_accepts_a_named_peer(self):
        self.assertEqual(self.check("lights/a.cpp", LICENCE + '#include "shapes/shape.h"\n'), [])

    def test_keeps_embree_behind_its_room(self):
        self.assertEqual(len(self.check("shapes/a.cpp", LICENCE + "#include <embree3/rtcore.h>\n")), 1)

    def test_wants_licence_and_guard(self):
        self.assertEqual(len(self.check("base/a.h", "int x;\n")), 2)


if __name__ == "__main__":
    unittest.main()
