# SPDX-License-Identifier: BSD-2-Clause
"""What a user can mend."""
import difflib
from collections.abc import Iterable


class CaseError(Exception):
    """Broken input: the message says where it is, what was found and what was expected."""


def unknown_word(what: str, word: str, known: Iterable[str]) -> str:
    """`what` "word"; did you mean ...? known: ..."""
    names = list(known)
    near = difflib.get_close_matches(word, names, 1)
    guess = f'; did you mean "{near[0]}"?' if near else ";"
    return f'unknown {what} "{word}"{guess} known: {", ".join(names)}'
