"""Files in which no key is silently wrong: a strict form, and a good sentence on every fault of what breaks it."""

from __future__ import annotations

import copy
import re
import tomllib
import typing
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationError, WithJsonSchema

from hysteresis_bench.errors import UserError, nearest, printable


class Strict(BaseModel):
    """A table of a TOML file: unknown keys and values of another type are faults, and what was read does not change."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


Form = TypeVar("Form", bound=Strict)

LONGEST_TIME = 1e9
"""Of a time limit, as a number: thirty years of seconds."""
SECONDS = {"s": 1.0, "sec": 1.0, "min": 60.0, "h": 3600.0}


def duration(text: Any) -> float:
    """ "10 min" -> 600.0 seconds; a bare number is seconds. Raises ValueError."""
    match = re.fullmatch(r"\s*([0-9.]+)\s*(s|sec|min|h)?\s*", str(text))
    if not match or not 0.0 < float(match[1]) < LONGEST_TIME:
        raise ValueError(f'{text!r} is not a time such as "90 s", "10 min" or "1 h"')
    return float(match[1]) * SECONDS[match[2] or "s"]


Seconds = Annotated[float, BeforeValidator(duration), WithJsonSchema({"type": ["number", "string"]})]
"""A time in a TOML file, such as "10 min"."""


def _ends(value: Any) -> tuple[float, float]:
    """[0, 1] -> (0, 1). Raises ValueError."""
    numbers = isinstance(value, (list, tuple)) and [type(end) for end in value if type(end) in (int, float)]
    if not numbers or len(numbers) != 2 or len(value) != 2:
        raise ValueError("should be two numbers, lower and upper, such as [0, 1]")
    return value[0], value[1]


Ends = Annotated[tuple[float, float], BeforeValidator(_ends)]
"""Lower and upper end of a range in a TOML file."""


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """The content of a TOML file, and its text. Raises UserError for a file that cannot be read."""
    try:
        text = path.read_text(encoding="utf-8")
        return tomllib.loads(text), text
    except OSError as error:
        raise UserError(str(path), f"cannot be read: {error.strerror}.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UserError(str(path), f"is not valid TOML: {error}.") from error


def tables(raw: Mapping[str, Any], key: str) -> list[dict[str, Any]]:
    """The tables of a [[key]], as far as they are tables: what is not is a fault of form."""
    value = raw.get(key)
    return [entry for entry in value if isinstance(entry, dict)] if isinstance(value, list) else []


def table(raw: Mapping[str, Any], key: str) -> dict[str, Any]:
    """The table of a key, empty where it is none."""
    value = raw.get(key)
    return value if isinstance(value, dict) else {}


def listed(raw: Mapping[str, Any], key: str) -> list[str]:
    """The names listed under a key, none where it is no list."""
    value = raw.get(key)
    return [str(entry) for entry in value] if isinstance(value, list) else []


def validated(form: type[Form], raw: Mapping[str, Any]) -> tuple[Form | None, dict[str, Any], list[str]]:
    """Parsed TOML in its form, or None; the content that has the right form; a sentence on every fault of form with
    the nearest known name. What a file names is looked up in the content that has the right form only."""
    try:
        return form.model_validate(dict(raw)), dict(raw), []
    except ValidationError as error:
        sound = copy.deepcopy(dict(raw))
        for fault in error.errors():
            _leave_out(sound, fault["loc"])
        return None, sound, list(dict.fromkeys(_sentence(form, fault) for fault in error.errors()))


def _leave_out(content: dict[str, Any], location: tuple[int | str, ...]) -> None:
    """Take off the key of a table that a fault lies in; a key that is missing, or a fault of a whole table, leaves the
    other keys of the table."""
    found: Any = content
    holder: dict[str, Any] | None = None
    key = ""
    for part in location:
        if isinstance(found, dict) and isinstance(part, str) and part in found:
            holder, key, found = found, part, found[part]
        elif isinstance(found, list) and isinstance(part, int) and part < len(found):
            found = found[part]
        elif isinstance(found, dict):
            return
        else:
            break
    whole_table = isinstance(found, dict) and len(location) == 2 and isinstance(location[-1], int)  # of a [[key]]
    if holder is not None and key in holder and not whole_table:
        del holder[key]


KINDS = {
    "string_type": "text, in quotes",
    "bool_type": "true or false",
    "int_type": "a whole number",
    "float_type": "a number",
    "tuple_type": "a list",
    "dict_type": "a table",
    "model_type": "a table",
}
"""What a file calls a type, by the name of its fault."""


def _sentence(form: type[Strict], fault: Any) -> str:
    place = _words(fault["loc"])
    if fault["type"] == "extra_forbidden":
        where, key = " ".join(place[:-1]), str(fault["loc"][-1])
        return f'{where + ": " if where else ""}no key "{key}". {nearest(key, _keys_of(form, fault["loc"][:-1]))}'
    if told := _brackets(form, fault):
        return told
    kind = KINDS.get(fault["type"])
    message = f"input should be {kind}" if kind else fault["msg"].removeprefix("Value error, ")
    return shown(f"{' '.join(place)}: {message[0].lower() + message[1:]}.")


def _brackets(form: type[Strict], fault: Any) -> str:
    """On a table that stands in the other kind of brackets, "" on any other fault."""
    key, given = "".join(map(str, fault["loc"][:1])), fault["input"]
    if len(fault["loc"]) != 1 or key not in form.model_fields or not any(_forms_in(form.model_fields[key].annotation)):
        return ""
    if fault["type"] == "list_type" and isinstance(given, dict):
        return f"[{key}] should be [[{key}]], in two brackets: there may be several."
    if fault["type"] == "model_type" and isinstance(given, list):
        return f"[[{key}]] should be [{key}], in one bracket: there is one."
    return ""


LONGEST, LONGEST_QUOTED = 1000, 100
"""Characters of a sentence, and of a text that it quotes, that are told: a file may hold a megabyte under one key."""


def shown(text: str) -> str:
    """Text that a terminal can print, cut where it quotes at length, so that what would be right is still told."""
    plain = re.sub(r'"[^"]*"', lambda quoted: f'"{_cut(quoted[0][1:-1], LONGEST_QUOTED)}"', printable(text))
    return _cut(plain, LONGEST)


def _cut(text: str, longest: int) -> str:
    return text if len(text) <= longest else f"{text[:longest]} ..."


def _words(location: tuple[int | str, ...]) -> list[str]:
    """("optimizer", 1, "settings") -> [[optimizer]] 2, settings; ("closing", "fitted") -> [closing], fitted."""
    words: list[str] = []
    for index, part in enumerate(location):
        if isinstance(part, int):
            words[-1] = f"[[{words[-1]}]] {part + 1}" if index == 1 else f"{words[-1]} {part + 1}"
        else:
            table = index == 0 and len(location) > 1 and isinstance(location[1], str)
            words.append(f"[{part}]" if table else part)
    return words


def _keys_of(form: type[Strict], location: tuple[int | str, ...]) -> list[str]:
    """The keys that the table at a location may have."""
    for part in location:
        field = form.model_fields.get(str(part))
        form = next(_forms_in(field.annotation), form) if field else form
    return list(form.model_fields)


def _forms_in(annotation: Any) -> Iterator[type[Strict]]:
    if isinstance(annotation, type) and issubclass(annotation, Strict):
        yield annotation
    for argument in typing.get_args(annotation):
        yield from _forms_in(argument)
