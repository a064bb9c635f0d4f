# SPDX-License-Identifier: BSD-2-Clause
"""Text of PBRT-v3 scenes, as far as needed to change a directive and to know which files a scene reads."""
import gzip
import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from .problems import CaseError

# A list of numbers is one token: grids have millions of them.
TOKEN = re.compile(r'\s+|#[^\n]*|\[[^\]"#]*\]|"(?:\\.|[^"\\])*"|[\[\]]|[^\s#"\[\]]+|"')
OPTIONS = ("Integrator", "Sampler", "PixelFilter", "Film", "Camera", "Accelerator")
"""Directives of which the last one before WorldBegin counts; a rewriting may change their type or add them."""
NAMED = ("MakeNamedMedium", "MakeNamedMaterial", "LightSource", "AreaLightSource", "Material", "Shape")
"""Directives that may stand anywhere, chosen by the string after them (a name or type; "*": all)."""


@dataclass(frozen=True)
class Token:
    text: str
    begin: int
    end: int

    def is_string(self) -> bool:
        return self.text.startswith('"')

    def string(self) -> str:
        """The text between the quotes."""
        return re.sub(r"\\(.)", r"\1", self.text[1:-1])

    def is_word(self) -> bool:
        return self.text[0].isalpha()


@dataclass
class Parameter:
    """One "type name" with its values as they are written; `begin` and `end` are offsets in the text."""
    declaration: str
    values: str
    begin: int
    end: int

    def name(self) -> str:
        return self.declaration.split()[-1]

    def text(self) -> str:
        return f'"{self.declaration}" {self.values}'


@dataclass
class Directive:
    """A word with the strings and parameters behind it. `first` is its first string, None if there is none."""
    word: str
    first: Token | None
    parameters: list[Parameter]
    begin: int
    end: int


def tokens(text: str) -> Iterator[Token]:
    """Words, strings, brackets; comments and space are left out."""
    for match in TOKEN.finditer(text):
        if not match.group().isspace() and match.group()[0] != "#":
            yield Token(match.group(), match.start(), match.end())


def last_of_value(found: list[Token], at: int) -> int | None:
    """Index of the last token of the value that begins at index `at`: a list in brackets, or one string or number."""
    if at >= len(found) or found[at].is_word():
        return None
    if found[at].text == "[":
        return next((i for i in range(at, len(found)) if found[i].text == "]"), None)
    return at


def directives(text: str) -> Iterator[Directive]:
    """All directives in order. Numbers behind a word (of transforms) are skipped."""
    found = list(tokens(text))
    at = 0
    while at < len(found):
        word = found[at]
        at += 1
        if not word.is_word():
            continue
        first, end = None, word.end
        if at < len(found) and found[at].is_string():
            first, end = found[at], found[at].end
            at += 1
        parameters: list[Parameter] = []
        while at < len(found) and not found[at].is_word():
            declaration = found[at]
            at, end = at + 1, declaration.end
            last = last_of_value(found, at)
            if not declaration.is_string() or len(declaration.string().split()) != 2 or last is None:
                continue  # a number of a transform, or a second name as MediumInterface has one
            at, end = last + 1, found[last].end
            parameters.append(Parameter(declaration.string(), text[declaration.end:end].strip(), declaration.begin, end))
        yield Directive(word.text, first, parameters, word.begin, end)


def read_text(path: Path) -> str:
    """A scene file, packed by gzip or not. Bytes that are no UTF-8 stay as they are."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise CaseError(f"{path}: {error.strerror}") from error
    if data[:2] == b"\x1f\x8b":
        data = gzip.decompress(data)
    return data.decode("utf-8", "surrogateescape")


def encode(text: str) -> bytes:
    return text.encode("utf-8", "surrogateescape")


def parse_rewriting(line: str) -> Directive:
    """One directive of a test case. Throws CaseError for one that cannot be rewritten."""
    found = list(directives(line))
    if len(found) != 1 or found[0].first is None:
        raise CaseError(f"rewrite: {line!r}: expected one directive, its type or name and parameters, as in a scene")
    if found[0].word not in OPTIONS + NAMED:
        raise CaseError(f"rewrite: {line!r}: {found[0].word} cannot be rewritten; known: {', '.join(OPTIONS + NAMED)}")
    return found[0]


def changed(old: Directive, new: Directive, text: str) -> str:
    """The directive `old` of `text` with the parameters of `new` in place of its own of the same names."""
    first = new.first if new.word in OPTIONS else old.first
    names = {p.name() for p in new.parameters}
    kept = [p for p in old.parameters if p.name() not in names]
    assert first is not None
    parts = [f"{old.word} {first.text}"] + [text[p.begin:p.end] for p in kept] + [p.text() for p in new.parameters]
    return " ".join(parts)


def matches(old: Directive, new: Directive) -> bool:
    if old.word != new.word or old.first is None or new.first is None:
        return False
    return new.word in OPTIONS or new.first.string() in ("*", old.first.string())


def rewrite_once(text: str, new: Directive, folder: Path) -> tuple[str, int]:
    """Changes every directive that `new` means, also in included files, which then stand in the text itself. Returns the
    text and how many there were."""
    out, at, count = [], 0, 0
    for old in directives(text):
        if matches(old, new):
            replacement, found = changed(old, new, text), 1
        elif old.word == "Include" and old.first is not None and (folder / old.first.string()).is_file():
            replacement, found = rewrite_once(read_text(folder / old.first.string()), new, folder)
            replacement = f"\n{replacement}\n"
        else:
            continue
        if found:
            out += [text[at:old.begin], replacement]
            at, count = old.end, count + found
    return "".join(out) + text[at:], count


def rewrite(text: str, lines: list[str], folder: Path) -> str:
    """The scene after the rewritings `lines` in their order. File names stay relative to `folder`, the one of the scene.
    Throws CaseError for a rewriting that meets nothing."""
    for line in lines:
        new = parse_rewriting(line)
        text, count = rewrite_once(text, new, folder)
        if count:
            continue
        world = next((d for d in directives(text) if d.word == "WorldBegin"), None)
        if new.word not in OPTIONS or world is None:
            raise CaseError(f"rewrite: {line!r}: the scene has no such directive")
        text = f"{text[:world.begin]}{line}\n{text[world.begin:]}"
    return text


def files_of(text: str, folder: Path) -> list[Path]:
    """Every file that a string in the text names, those of included files too, each once, in order. A string that
    happens to be the name of a file counts as one: at worst a slice is rendered again."""
    found: dict[Path, None] = {}
    waiting = [text]
    while waiting:
        for token in tokens(waiting.pop()):
            if not token.is_string() or len(token.text) > 4096 or "\0" in token.text:
                continue
            path = folder / token.string()
            try:
                if not token.string() or path in found or not path.is_file():
                    continue
            except OSError:  # no name of a file
                continue
            found[path] = None
            if path.name.endswith((".pbrt", ".pbrt.gz")):
                waiting.append(read_text(path))
    return list(found)


def scene_hash(text: str, folder: Path) -> str:
    """16 hexadecimal digits over the text and the bytes of all files that it names."""
    digest = hashlib.sha256(encode(text))
    for path in files_of(text, folder):
        digest.update(str(path.relative_to(folder) if path.is_relative_to(folder) else path).encode("utf-8", "surrogateescape"))
        with path.open("rb") as file:
            while block := file.read(1 << 20):
                digest.update(block)
    return digest.hexdigest()[:16]
