"""What a command has fitted so far, in a file beside its results: a run that was stopped goes on from it.

A line an answer: the digest of what was asked, the digest of the rest of the line, and the answer as JSON, every
number to the last bit. What was asked is told by its content: the records, the model, the parameters already known.
"""

from __future__ import annotations

import json
from base64 import b64decode, b64encode
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import fields, is_dataclass
from functools import cached_property
from hashlib import sha256
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.commands.outputs import UNFINISHED
from hysteresis_bench.diagnosis.doubt.other_laws import Contender
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Behind, Hypothesis
from hysteresis_bench.diagnosis.hypotheses.smooth_fitter import Smooth
from hysteresis_bench.diagnosis.laws.law import Law
from hysteresis_bench.errors import UserError
from hysteresis_bench.study.origin import processor, versions

ANSWERS: Mapping[str, type] = {kind.__name__: kind for kind in (Hypothesis, Behind, Smooth, Law, Contender)}


@contextmanager
def journal(folder: Path, asked: object) -> Iterator[Journal]:
    """What earlier runs in the folder kept of the same question; gone where the block comes to its end, or is refused.

    asked : all that the answers depend on, but the code
    """
    kept = Journal(folder / UNFINISHED, digest((made_with(), asked)))
    try:
        yield kept
    except UserError:
        kept.remove()
        raise
    kept.remove()


class Journal:
    """Answers by what was asked, written as they come; nothing is written before the first.

    notes : what could not be used, a sentence each;  known : how many answers earlier runs left
    """

    def __init__(self, path: Path, of: str) -> None:
        self.path, self._of, self._answers = path, of, dict[str, str]()
        self.notes = tuple(self._read())
        self.known = len(self._answers)

    def get(self, question: tuple[Any, ...]) -> Any | None:
        text = self._answers.get(digest(question))
        return None if text is None else _restored(json.loads(text))

    def __setitem__(self, question: tuple[Any, ...], answer: Any) -> None:
        key, text = digest(question), json.dumps(_spelled(answer))
        self._answers[key] = text
        with self._opened.open("a", encoding="utf-8") as file:
            file.write(f"\n{key} {_sum(text)} {text}")

    def words(self) -> str:
        """What is kept, as a clause."""
        count = len(self._answers)
        fits = "1 finished fit is" if count == 1 else f"{count} finished fits are"
        return f"{fits} kept in {self.path}" if count else f"nothing was written to {self.path.parent}"

    def remove(self) -> None:
        """With its folder, where nothing else is in it."""
        self.path.unlink(missing_ok=True)
        with suppress(OSError):
            self.path.parent.rmdir()

    @cached_property
    def _opened(self) -> Path:
        """The file, that of another question replaced."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        if not self.known:
            self.path.write_text(self._of, encoding="utf-8")
        return self.path

    def _read(self) -> Iterator[str]:
        if not self.path.is_file():
            return
        of, *lines = self.path.read_text(encoding="utf-8", errors="replace").split("\n")
        if of != self._of:
            yield f"{self.path} is of other data, other options or another version, and is not used."
            return
        damaged = 0
        for line in lines:
            key, _, rest = line.partition(" ")
            told, _, text = rest.partition(" ")
            if told == _sum(text):
                self._answers[key] = text
            else:
                damaged += 1
        if self._answers:
            fits = "1 fit" if len(self._answers) == 1 else f"{len(self._answers)} fits"
            yield f"Used of a run that was stopped: {fits}, from {self.path}."
        if damaged:
            yield f"{self.path}: {damaged} of {len(lines)} lines are damaged; what they held is fitted again."


def digest(thing: object) -> str:
    """SHA-256 of a value's content; of a dataclass, of its fields that count when two are compared."""
    return sha256("\n".join(_content(thing)).encode()).hexdigest()


def made_with() -> str:
    """SHA-256 of all code that a fit may run, with the versions of packages, and the processor."""
    groups = [f"hysteresis_bench.{kind}" for kind in registry.CONTRACTS]
    homes = {entry.module.partition(".")[0] for group in groups for entry in entry_points(group=group)}
    found = []
    for home in sorted({"hysteresis_bench", *homes}):
        spec = find_spec(home)
        places = [*(spec.submodule_search_locations or [spec.origin or ""])] if spec else []
        found += [sha256(file.read_bytes()).hexdigest() for place in places for file in _sources(Path(place))]
    return digest((found, versions(), processor()))


def _sources(place: Path) -> list[Path]:
    return [place] if place.is_file() else sorted(place.rglob("*.py"))


def _content(thing: object) -> Iterator[str]:
    """Texts that two things share where they are alike."""
    yield f"{type(thing).__module__}.{type(thing).__qualname__}"
    match thing:
        case np.ndarray():
            yield f"{thing.dtype} {thing.shape} {sha256(np.ascontiguousarray(thing).tobytes()).hexdigest()}"
        case Mapping():
            yield from (digest(pair) for pair in thing.items())
        case set() | frozenset():
            yield from sorted(map(digest, thing))
        case list() | tuple():
            yield from map(digest, thing)
        case _ if is_dataclass(thing):
            counted = [field.name for field in fields(thing) if field.compare]
            yield from (digest((name, getattr(thing, name))) for name in counted)
        case _ if hasattr(thing, "__qualname__"):
            yield f"{thing.__module__}.{thing.__qualname__}"
        case _ if hasattr(thing, "__dict__"):
            yield digest(vars(thing))
        case _:
            yield repr(thing)


def _sum(text: str) -> str:
    return sha256(text.encode()).hexdigest()


def _spelled(value: Any) -> Any:
    """As JSON; the kinds that it has no form for by name."""
    match value:
        case np.ndarray():
            return {"array": b64encode(value.astype(float).tobytes()).decode()}
        case frozenset():
            return {"set": sorted(value)}
        case tuple():
            return {"tuple": [_spelled(one) for one in value]}
        case Mapping():
            return {"mapping": {key: _spelled(one) for key, one in value.items()}}
        case _ if is_dataclass(value):
            return {type(value).__name__: {field.name: _spelled(getattr(value, field.name)) for field in fields(value)}}
    return value


def _restored(spelled: Any) -> Any:
    if not isinstance(spelled, dict):
        return spelled
    ((kind, content),) = spelled.items()
    match kind:
        case "array":
            return np.frombuffer(b64decode(content)).copy()
        case "set":
            return frozenset(content)
        case "tuple":
            return tuple(map(_restored, content))
    known = {key: _restored(one) for key, one in content.items()}
    return known if kind == "mapping" else ANSWERS[kind](**known)
