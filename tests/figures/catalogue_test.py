# SPDX-License-Identifier: BSD-2-Clause
"""Every script is a figure, and no name is both there and not there."""
import unittest

from figurekit.catalogue import FOLDER, PAPERS, all_figures, order, paper_of, title_of
from figurekit.main import chosen
from figurekit.not_there import NOT_THERE
from figurekit.programs import FigureError


class CatalogueTest(unittest.TestCase):
    def setUp(self):
        self.entries = all_figures()
        self.names = [e.name for e in self.entries]

    def test_every_script_is_listed_once_and_says_what_it_is(self):
        self.assertEqual(len(self.entries), len(list(FOLDER.glob("*.py"))))
        self.assertEqual(len(set(self.names)), len(self.names))
        for entry in self.entries:
            for text in (entry.figure.title, entry.figure.reported, entry.figure.settings):
                self.assertGreater(len(text), 10, entry.name)
            self.assertIn(entry.paper, PAPERS)

    def test_what_is_not_there_yet_has_a_reason_and_no_script(self):
        for name, why in NOT_THERE.items():
            self.assertNotIn(name, self.names)
            self.assertIn(paper_of(name), PAPERS)
            self.assertGreater(len(why), 10)

    def test_names_are_in_the_order_of_papers_and_numbers(self):
        self.assertEqual(self.names, sorted(self.names, key=order))
        self.assertEqual(title_of("misso-2022-03"), "Figure 3")

    def test_the_beginning_of_names_chooses_all_that_have_it(self):
        found = [e.name for e in chosen(["kettunen-2021-05", "georgiev-2019"], self.entries)]
        self.assertEqual(found, [n for n in self.names if n.startswith("georgiev-2019-")] + ["kettunen-2021-05"])

    def test_an_unknown_name_is_told_with_the_nearest(self):
        with self.assertRaisesRegex(FigureError, 'unknown figure "ketunen-2021-05"; did you mean kettunen-2021-05'):
            chosen(["ketunen-2021-05"], self.entries)

    def test_a_figure_that_is_not_there_yet_tells_why(self):
        for name, why in list(NOT_THERE.items())[:1]:
            with self.assertRaises(FigureError) as caught:
                chosen([name], self.entries)
            self.assertIn(why, str(caught.exception))
