#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""The list of planted faults must be read as it is meant, and its mistakes found."""
import pathlib
import tempfile
import unittest

import mutations

PLAN = """# Architecture
## Rooms
| room | holds | may include peers |
| --- | --- | --- |
| `base` | numbers | |
| `media` | media | |

### Folders in rooms
| folder | holds |
| --- | --- |
| `media/phase` | phase functions |
"""
FILES = {
    "docs/architecture.md": PLAN,
    "src/base/a.cpp": "int f() { return 1 + 2; }\n",
    "src/media/phase/p.cpp": "  a();\n  b();\n  c(1);\n  d(1);\n",
    "exporters/e.cpp": "x = y;\n",
    "tests/base/CMakeLists.txt": "# none.cpp\nroom_test(base\n  SOURCES a_test.cpp\n    help.cpp\n  DEPENDS base)\n",
    "tests/media/CMakeLists.txt": "room_test(media SOURCES p_test.cpp DEPENDS media)\n"
                                  "room_test(media_stat SOURCES q_test.cpp LABEL stat)\n",
}
SUM = "sum: adds wrongly\nin src/base/a.cpp\n- 1 + 2\n+ 1 - 2\nby base/a_test.cpp Sum.*\n"
CALL = "call: is not made\nin src/media/phase/p.cpp\n-   a();\n-   b();\n+   a();\nby media/q_test.cpp Call.*\n"
COPY = "copy: is lost\nin exporters/e.cpp\n- x = y;\nby base/a_test.cpp Copy.*\n"


class Mutations(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name, text in FILES.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)

    def problems(self, *blocks: str) -> list[str]:
        return mutations.list_problems(self.root, mutations.parse("\n".join(["# comment\n", *blocks])))

    def expect_one(self, part: str, *blocks: str):
        found = self.problems(*blocks)
        self.assertEqual(len(found), 1, found)
        self.assertIn(part, found[0])

    def test_reads_a_block(self):
        sum_, call, copy = mutations.parse("\n".join([SUM, CALL, COPY]))
        self.assertEqual((sum_.name, sum_.words, sum_.before, sum_.after), ("sum", "adds wrongly", "1 + 2", "1 - 2"))
        self.assertEqual((sum_.test, sum_.filter, sum_.room()), ("base/a_test.cpp", "Sum.*", "base"))
        self.assertEqual((call.before, call.after, call.room()), ("  a();\n  b();", "  a();", "media/phase"))
        self.assertEqual((copy.after, copy.room()), ("", "exporters"))

    def test_accepts_a_list_of_every_room(self):
        self.assertEqual(self.problems(SUM, CALL, COPY), [])

    def test_refuses_a_block_without_its_parts(self):
        for broken in (SUM.replace("by ", "of "), SUM.replace(" Sum.*", ""), SUM.replace("- 1 + 2\n", ""), "sum\n" + SUM):
            with self.assertRaises(mutations.ListError):
                mutations.parse(broken)

    def test_finds_a_text_that_is_not_there_or_there_twice(self):
        self.expect_one("occurs 0 times", SUM.replace("1 + 2", "1 + 3"), CALL, COPY)
        self.expect_one("occurs 2 times", SUM, CALL.replace("  a();\n-   b();", "(1)"), COPY)

    def test_finds_a_file_that_is_not_there(self):
        self.expect_one("there is no src/base/b.cpp", SUM.replace("a.cpp", "b.cpp"), CALL, COPY)
        self.expect_one("there is no docs/architecture.md", SUM, CALL, COPY,
                        "doc: is told\nin docs/architecture.md\n- numbers\nby base/a_test.cpp *\n")

    def test_finds_a_test_that_no_list_names(self):
        self.expect_one("tests/base/b_test.cpp", SUM.replace("a_test", "b_test"), CALL, COPY)

    def test_finds_faults_that_are_none_or_stand_twice(self):
        self.expect_one("changes nothing", SUM.replace("1 - 2", "1 + 2"), CALL, COPY)
        self.expect_one("stands twice", SUM, CALL, COPY, COPY.replace("copy:", "other:"))

    def test_finds_rooms_without_faults(self):
        self.expect_one("planted in exporters", SUM, CALL)
        self.assertEqual(len(self.problems(SUM, COPY)), 2)

    def test_knows_the_program_of_each_test(self):
        self.assertEqual(mutations.programs(self.root), {
            "base/a_test.cpp": "base", "base/help.cpp": "base", "media/p_test.cpp": "media",
            "media/q_test.cpp": "media_stat"})
        lists = mutations.alone_lists(self.root, [m.test for m in mutations.parse("\n".join([SUM, CALL]))])
        self.assertIn("test_alone(alone_base_a_test base base/a_test.cpp base/help.cpp)", lists)
        self.assertIn("test_alone(alone_media_q_test media_stat media/q_test.cpp)", lists)

    def test_results_belong_to_the_fault_as_it_is(self):
        (self.root / "docs").mkdir(exist_ok=True)
        before = mutations.parse("\n".join([SUM, CALL]))
        rows = {m.key(): [m.key(), m.name, result, by] for m, result, by in zip(before, ["red", "green"], ["T.x", ""])}
        mutations.write_results(self.root, before, rows)
        self.assertEqual(mutations.read_results(self.root), rows)
        after = mutations.parse("\n".join([SUM, CALL.replace("a();\nby", "b();\nby")]))
        page = mutations.page(after, mutations.read_results(self.root))
        self.assertIn("2 faults: 1 red, 1 not run.", page)
        self.assertIn("| adds wrongly | `src/base/a.cpp` | `1 + 2` → `1 - 2` | red | T.x |", page)

    def test_draws_the_same_faults_from_the_same_seed(self):
        all_ = mutations.parse("\n".join([SUM, CALL, COPY]))
        self.assertEqual(mutations.choose(all_, [], 2, 7), mutations.choose(all_, [], 2, 7))
        self.assertEqual(len(mutations.choose(all_, [], 5, 7)), 3)
        self.assertEqual([m.name for m in mutations.choose(all_, ["copy"], None, 1)], ["copy"])
        with self.assertRaises(mutations.ListError):
            mutations.choose(all_, ["cop"], None, 1)

    def test_shortens_what_noticed(self):
        self.assertEqual(mutations.shown(["All/A.x/0", "All/A.x/halton", "B/3.y"]), "All/A.x, B.y")
        self.assertEqual(mutations.shown(["A.a", "A.b", "A.c", "A.d"]), "A.a, A.b, A.c and 1 more")


if __name__ == "__main__":
    unittest.main()
