#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""The check of the house must find what it is there to find."""
import pathlib
import tempfile
import unittest

import check_house

LICENCE = "// SPDX-License-Identifier: BSD-2-Clause\n"
PLAN = """# Architecture
## Rooms
| room | holds | may include peers |
| --- | --- | --- |
| `base` | numbers | |
| `cameras` `film` `filters` | plugins | `film`→`filters` |
| `media` | media | |

### Folders in rooms
| folder | holds |
| --- | --- |
| `media/phase` | phase functions |

More text.
"""
FILES = {
    "src/base/CMakeLists.txt": "room(base SOURCES a.cpp)",
    "src/base/a.cpp": LICENCE,
    "src/cameras/c.h": LICENCE + "#pragma once\n",
    "src/film/f.h": LICENCE + "#pragma once\n",
    "src/filters/g.h": LICENCE + "#pragma once\n",
    "src/media/phase/p.h": LICENCE + "#pragma once\n",
    "tests/base/CMakeLists.txt": "# z.cpp\nroom_test(base SOURCES a_test.cpp)",
    "tests/base/a_test.cpp": LICENCE,
}


class CheckHouse(unittest.TestCase):
    def check(self, **changes: str) -> list[str]:
        """The problems of the small house above with some files written anew; empty text: without it."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            files = {"docs/architecture.md": PLAN} | FILES | changes.pop("files", {})
            for name, text in files.items():
                if text:
                    (root / name).parent.mkdir(parents=True, exist_ok=True)
                    (root / name).write_text(text)
            return check_house.problems(root)

    def expect_one(self, part: str, files: dict[str, str]):
        found = self.check(files=files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(part, found[0])

    def test_accepts_the_house(self):
        self.assertEqual(self.check(), [])

    def test_accepts_an_include_that_points_down_and_a_named_peer(self):
        self.assertEqual(self.check(files={
            "src/film/f.h": LICENCE + '#pragma once\n#include "base/a.h"\n#include "filters/g.h"\n'}), [])

    def test_rejects_an_include_that_points_up(self):
        self.expect_one("points up", {"src/base/a.cpp": LICENCE + '#include "media/medium.h"\n'})

    def test_rejects_an_unnamed_peer(self):
        self.expect_one("peer", {"src/cameras/c.h": LICENCE + '#pragma once\n#include "film/f.h"\n'})

    def test_keeps_embree_behind_its_room(self):
        self.expect_one("belongs to", {"src/base/a.cpp": LICENCE + "#include <embree3/rtcore.h>\n"})

    def test_rejects_an_included_source(self):
        self.expect_one("is a source", {"src/base/a.cpp": LICENCE + '#include "base/b.cpp"\n'})

    def test_wants_licence_and_guard(self):
        self.assertEqual(len(self.check(files={"src/film/f.h": "int x;\n"})), 2)

    def test_rejects_a_room_that_the_plan_does_not_know(self):
        self.assertGreater(len(self.check(files={"src/attic/x.h": LICENCE + "#pragma once\n"})), 0)

    def test_rejects_a_plan_of_rooms_that_are_not_there(self):
        self.expect_one("not there", {"src/film/f.h": ""})
        self.expect_one("not there", {"src/media/phase/p.h": "", "src/media/q.h": LICENCE + "#pragma once\n"})

    def test_rejects_a_folder_that_the_plan_does_not_know(self):
        self.expect_one("not in the plan", {"src/media/more/x.h": LICENCE + "#pragma once\n"})

    def test_finds_a_test_that_no_list_names(self):
        self.expect_one("in no list", {"tests/base/b_test.cpp": LICENCE})

    def test_finds_a_source_that_a_comment_names(self):
        self.expect_one("in no list", {"tests/base/z.cpp": LICENCE})

    def test_finds_a_source_that_is_built_in_another_room(self):
        found = self.check(files={"tests/film/CMakeLists.txt": "room_test(film SOURCES ../base/a_test.cpp)"})
        self.assertTrue(any("another room" in f for f in found), found)

    def test_finds_a_name_without_a_source(self):
        self.expect_one("but not there", {"src/base/CMakeLists.txt": "room(base SOURCES a.cpp b.cpp)"})


if __name__ == "__main__":
    unittest.main()
