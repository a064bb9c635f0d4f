# SPDX-License-Identifier: BSD-2-Clause
"""What is compared: the test-case file, read and checked. docs/comparing.md describes its keys."""
import dataclasses
import itertools
import json
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .problems import CaseError, unknown_word
from .scene_text import parse_rewriting

UNITS = ("seconds", "lookups", "samples")
CLOCKS = ("cpu", "wall")
IMAGES = ("exr", "pfm", "png", "tga")
MEDIUM_WORDS = ("transmittance", "freeflight", "bounds", "law", "pattern")
"""Short words of a setting that are parameters of media."""
RENDER_WORDS = {"integrator": "Integrator", "sampler": "Sampler"}
"""Short words of a setting that are directives of the scene."""
SHORT_WORDS = (*MEDIUM_WORDS, *RENDER_WORDS)


@dataclass(frozen=True)
class Setting:
    """One way to render a scene: a row of every table, a line of every plot."""
    name: str
    medium: str = ""                  # what pbrt --mediumparams takes
    rewrite: tuple[str, ...] = ()     # directives, see scene_text.rewrite
    options: tuple[str, ...] = ()     # further options of the program
    program: str = ""                 # another pbrt with the same options; "": the one of the build
    command: str = ""                 # template of any other program, see programs.py
    image: str = "exr"                # what that writes: suffix of {outfile}
    reference_only: bool = False      # makes the reference and is not compared


@dataclass(frozen=True)
class SceneCase:
    """One scene with what its comparison has of its own."""
    file: Path
    name: str
    budget: float
    rewrite: tuple[str, ...] = ()
    options: tuple[str, ...] = ()
    reference: Path | None = None     # an image; None: made by the reference setting


@dataclass(frozen=True)
class Case:
    """Scenes x settings, and how long each may render."""
    title: str
    scenes: tuple[SceneCase, ...]
    settings: tuple[Setting, ...]
    equal: str = "seconds"            # what the budget is a number of
    clock: str = "cpu"                # which seconds those are
    budget: float = 10                # of each setting, scene and repeat: seconds, look-ups, or samples a pixel
    slices: int = 8                   # into which a budget is divided
    repeats: int = 4                  # independent runs, from which all intervals are
    threads: int = 0                  # 0: one per processor
    seed: int = 1                     # the first of all seeds
    epsilon: float = 0.01             # of relative errors, squared radiance
    options: tuple[str, ...] = ()     # of every run of pbrt
    reference_setting: str = ""       # the first setting if ""
    reference_times: float = 16       # cost of a reference in budgets

    def compared(self) -> list[Setting]:
        return [s for s in self.settings if not s.reference_only]

    def setting(self, name: str) -> Setting:
        return next(s for s in self.settings if s.name == name)

    def reference_maker(self) -> Setting:
        return self.setting(self.reference_setting)


def method_parameters(kind: str, method: str) -> str:
    """`kind` "ratio+roulettethreshold=0.3" becomes "string kind" "ratio" "float roulettethreshold" 0.3, a directive's type likewise."""
    name, *values = method.split("+")
    text = f'{kind} "{name}"'
    for value in values:
        parameter, equals, number = value.partition("=")
        if not equals or not parameter or not number:
            raise CaseError(f'"{method}": expected NAME+PARAMETER=NUMBER+..., found "{value}"')
        text += f' "float {parameter}" {number}'
    return text


def expand_words(words: dict[str, str], medium: str, rewrite: tuple[str, ...]) -> tuple[str, tuple[str, ...]]:
    """Short words as parameters of media and as rewritings, before those that are there."""
    media = [method_parameters(f'"string {w}"', words[w]) for w in MEDIUM_WORDS if w in words]
    lines = [method_parameters(RENDER_WORDS[w], words[w]) for w in RENDER_WORDS if w in words]
    return " ".join([*media, *([medium] if medium else [])]), (*lines, *rewrite)


class Table:
    """A table of the file from which each key is taken once; what is left over is an error."""

    def __init__(self, content: Any, where: str):
        if not isinstance(content, dict):
            raise CaseError(f"{where}: expected a table, found {content!r}")
        self.content, self.where, self.taken = dict(content), where, []

    def take(self, key: str, kind: type | tuple[type, ...], default: Any = None) -> Any:
        self.taken.append(key)
        value = self.content.pop(key, default)
        wrong_bool = isinstance(value, bool) and kind is not bool
        if value is not default and (wrong_bool or not isinstance(value, kind)):
            names = " or ".join(k.__name__ for k in (kind if isinstance(kind, tuple) else (kind,)))
            raise CaseError(f"{self.where}: {key}: expected {names}, found {value!r}")
        return value

    def number(self, key: str, default: float, least: float, whole: bool = False) -> Any:
        value = self.take(key, int if whole else (int, float), default)
        if not least <= value < 1e300:
            raise CaseError(f"{self.where}: {key}: expected a number of at least {least:g}, found {value!r}")
        return value

    def choice(self, key: str, known: tuple[str, ...], default: str) -> str:
        value = self.take(key, str, default)
        if value not in known:
            raise CaseError(f"{self.where}: {unknown_word(key, value, known)}")
        return value

    def strings(self, key: str) -> tuple[str, ...]:
        values = self.take(key, (list, str), [])
        values = [values] if isinstance(values, str) else values
        if not all(isinstance(v, str) for v in values):
            raise CaseError(f"{self.where}: {key}: expected strings, found {values!r}")
        return tuple(values)

    def end(self) -> None:
        for key in self.content:
            raise CaseError(f"{self.where}: {unknown_word('key', key, self.taken)}")


def read_setting(content: Any, where: str) -> Setting:
    table = Table(content, where)
    words = {w: v for w in SHORT_WORDS if (v := table.take(w, str)) is not None}
    medium, rewrite = expand_words(words, table.take("medium", str, ""), table.strings("rewrite"))
    name = table.take("name", str, "") or ", ".join(words.values())
    if not name:
        raise CaseError(f"{where}: a setting needs a name")
    setting = Setting(name, medium, rewrite, table.strings("options"), table.take("program", str, ""), table.take("command", str, ""),
                      table.choice("image", IMAGES, "exr"), table.take("reference_only", bool, False))
    table.end()
    for line in rewrite:
        parse_rewriting(line)
    if setting.command and (setting.medium or setting.program or setting.options):
        raise CaseError(f'{where}: "{name}": a command takes no medium parameters, options or program: they are parts of it')
    return setting


def read_matrix(content: Any, where: str) -> list[Setting]:
    """All combinations of lists of short words."""
    table = Table(content, where)
    lists = {w: values for w in SHORT_WORDS if (values := table.strings(w))}
    table.end()
    if not lists:
        raise CaseError(f"{where}: expected lists; known: {', '.join(SHORT_WORDS)}")
    # A word that does not vary is no part of a name, unless nothing varies.
    naming = [w for w in lists if len(lists[w]) > 1] or list(lists)
    settings = []
    for values in itertools.product(*lists.values()):
        words = dict(zip(lists, values))
        settings.append(read_setting({**words, "name": ", ".join(words[w] for w in naming)}, where))
    return settings


def read_scene(content: Any, where: str, folder: Path, budget: float) -> SceneCase:
    table = Table(content, where)
    file = table.take("file", str, "")
    if not file:
        raise CaseError(f"{where}: a scene needs a file")
    path = (folder / file).resolve()
    if not path.is_file():
        raise CaseError(f'{where}: no scene "{path}"')
    reference = table.take("reference", str, "")
    scene = SceneCase(path, table.take("name", str, path.stem), table.number("budget", budget, 1e-9), table.strings("rewrite"),
                      table.strings("options"), (folder / reference).resolve() if reference else None)
    table.end()
    if scene.reference and not scene.reference.is_file():
        raise CaseError(f'{where}: no reference "{scene.reference}"')
    for line in scene.rewrite:
        parse_rewriting(line)
    return scene


def unique(kind: str, names: list[str], where: str) -> None:
    for name in names:
        if names.count(name) > 1:
            raise CaseError(f'{where}: two {kind}s are named "{name}"; give them names')


def read_case(content: Any, where: str, folder: Path) -> Case:
    """The case that a parsed file `content` describes. `where` names it in messages, file names are relative to `folder`."""
    table = Table(content, where)
    settings = [read_setting(s, f"{where}: setting {i}") for i, s in enumerate(table.take("setting", list, []), 1)]
    matrix = table.take("matrix", dict)
    if matrix is not None:
        settings += read_matrix(matrix, f"{where}: matrix")
    budget = table.number("budget", 10, 1e-9)
    scenes = [read_scene(s, f"{where}: scene {i}", folder, budget) for i, s in enumerate(table.take("scene", list, []), 1)]
    reference = Table(table.take("reference", dict, {}), f"{where}: reference")
    names = [s.name for s in settings]
    if not scenes or all(s.reference_only for s in settings):
        raise CaseError(f"{where}: expected at least one scene and one setting")
    unique("scene", [s.name for s in scenes], where)
    unique("setting", names, where)
    case = Case(
        title=table.take("title", str, Path(where).stem), scenes=tuple(scenes), settings=tuple(settings),
        equal=table.choice("equal", UNITS, "seconds"), clock=table.choice("clock", CLOCKS, "cpu"), budget=budget,
        slices=table.number("slices", 8, 2, whole=True), repeats=table.number("repeats", 4, 2, whole=True),
        threads=table.number("threads", 0, 0, whole=True), seed=table.number("seed", 1, 0, whole=True),
        epsilon=table.number("epsilon", 0.01, 1e-12), options=table.strings("options"),
        reference_setting=reference.take("setting", str, names[0]), reference_times=reference.number("times", 16, 1))
    reference.end()
    table.end()
    if case.reference_setting not in names:
        raise CaseError(f"{where}: reference: {unknown_word('setting', case.reference_setting, names)}")
    return case


def load_case(path: Path) -> Case:
    """Reads a .toml or .json file."""
    try:
        text = path.read_text()
        content = json.loads(text) if path.suffix == ".json" else tomllib.loads(text)
    except OSError as error:
        raise CaseError(f"{path}: {error.strerror}") from error
    except (ValueError, tomllib.TOMLDecodeError) as error:
        raise CaseError(f"{path}: {error}") from error
    return read_case(content, str(path), path.parent)


def quick(case: Case) -> Case:
    """An eighth of every budget in half the slices, three repeats, and a reference of eight of these budgets."""
    return dataclasses.replace(
        case, budget=case.budget / 8, slices=max(2, case.slices // 2), repeats=min(3, case.repeats), reference_times=min(8, case.reference_times),
        scenes=tuple(dataclasses.replace(s, budget=s.budget / 8) for s in case.scenes))
