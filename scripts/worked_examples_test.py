#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Worked examples must be done as they are written, or refused."""
import unittest

import worked_examples as examples

PAGE = """# Plan
## Worked examples

Words.

### A number

1. copy `src/one.h` to `src/two.h`, with `Two` for `One` and `2` for
   `1`
2. in `src/list.h` put `\\nTwo,` after `One,`
3. in `src/list.h` put `count 2` for `count 1`
4. run `bin/count --all`: `Two`

More words.

## Next
"""
FILES = {"src/one.h": "One is 1", "src/list.h": "One,\ncount 1\n"}


class WorkedExamples(unittest.TestCase):
    def result(self, page: str = PAGE) -> dict[str, str]:
        tree: dict[str, str] = {}
        for example in examples.parse(page):
            examples.apply(tree, example, FILES.get)
        return tree

    def test_are_done_step_by_step(self):
        tree = self.result()
        self.assertEqual(tree["src/two.h"], "Two is 2")
        self.assertEqual(tree["src/list.h"], "One,\nTwo,\ncount 2\n")
        example = examples.parse(PAGE)[0]
        self.assertEqual(example.runs, [("bin/count --all", "Two")])
        self.assertEqual(examples.targets_of(example), {"count"})

    def refused(self, old: str, new: str, words: str):
        self.assertIn(old, PAGE)
        with self.assertRaisesRegex(examples.ExampleError, words):
            self.result(PAGE.replace(old, new))

    def test_are_refused_where_the_tree_is_another(self):
        self.refused("src/one.h", "src/none.h", "there is no src/none.h")
        self.refused("src/two.h", "src/one.h", "is there already")
        self.refused("after `One,`", "after `Three,`", "occurs 0 times in src/list.h")
        self.refused("`2` for\n   `1`", "`2` for\n   `7`", 'has no "7"')

    def test_are_refused_where_a_step_is_not_understood(self):
        self.refused("in `src/list.h` put `count 2` for", "write `count 2` to `src/list.h` for", "no step")
        self.refused("4. run `bin/count --all`: `Two`\n", "", "expected steps")


if __name__ == "__main__":
    unittest.main()
