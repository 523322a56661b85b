"""Arrays as np.savez packs them, read without a file and an archive for each: a study has tens of thousands of traces.

[1] PKWARE, APPNOTE.TXT, .ZIP File Format Specification 6.3.10, sections 4.3.7, 4.3.12 and 4.3.16.
"""

from __future__ import annotations

import io
import struct
from functools import lru_cache
from zlib import crc32

import numpy as np

from hysteresis_bench.arrays import Array

LOCAL, MEMBER, END = (struct.Struct(form) for form in ("<4s2H3H3I2H", "<4s4H2H3I5H2I", "<4s4H2IH"))
"""[1] Heads of a file in the archive, of its entry in the directory at the end, and the end."""
AS_IT_IS = 0
"""[1] Compression method of what is only stored."""
ZIP64 = 45
"""[1] Version that a reader needs for the heads that np.savez writes."""
MAGIC = b"\x93NUMPY\x01\x00"
PREFIX = len(MAGIC) + 2


def unpacked(blob: bytes) -> dict[str, Array]:
    """Name -> array. Whatever is not exactly as np.savez writes it, damaged or not, is left to np.load, and raises what
    that raises."""
    try:
        return _stored(blob)
    except (_Unusual, struct.error):
        with np.load(io.BytesIO(blob)) as arrays:
            return {name: arrays[name] for name in arrays.files}


class _Unusual(Exception):
    """Not as np.savez writes it."""


def _stored(blob: bytes) -> dict[str, Array]:
    mark, *disks, _, count, size, start, comment = END.unpack_from(blob, max(len(blob) - END.size, 0))
    _expect(mark == b"PK\5\6" and disks == [0, 0] and comment == 0 and start + size + END.size == len(blob))
    found = {}
    for _ in range(count):
        mark, _, needed, flags, method, _, _, crc, packed, length, *names, _, _, _, at = MEMBER.unpack_from(blob, start)
        _expect(mark == b"PK\1\2" and needed <= ZIP64 and flags == 0 and method == AS_IT_IS and packed == length)
        name = blob[start + MEMBER.size : start + MEMBER.size + names[0]]
        _expect(name.endswith(b".npy") and name.isascii())
        start += MEMBER.size + sum(names)
        mark, *_, own, extra = LOCAL.unpack_from(blob, at)
        begun = at + LOCAL.size + own + extra
        _expect(mark == b"PK\3\4" and blob[at + LOCAL.size : at + LOCAL.size + own] == name)
        content = memoryview(blob)[begun : begun + length]
        _expect(len(content) == length and crc32(content) == crc)
        found[name[: -len(".npy")].decode()] = _array(content)
    _expect(start + END.size == len(blob))
    return found


def _array(content: memoryview) -> Array:
    """Of a file in the form .npy, version 1.0."""
    _expect(bytes(content[: len(MAGIC)]) == MAGIC)
    begun = PREFIX + int.from_bytes(content[len(MAGIC) : PREFIX], "little")
    kind, fortran, shape = _head(bytes(content[PREFIX:begun]))
    _expect(len(content) - begun == kind.itemsize * int(np.prod(shape, dtype=object)))
    # a copy is aligned, can be written to, and does not hold what it was read from
    return np.frombuffer(content[begun:], kind).reshape(shape, order="F" if fortran else "C").copy(order="K")


@lru_cache(maxsize=1024)
def _head(text: bytes) -> tuple[np.dtype, bool, tuple[int, ...]]:
    """Kind of numbers, whether columns are together, shape."""
    try:
        shape, fortran, kind = np.lib.format.read_array_header_1_0(io.BytesIO(len(text).to_bytes(2, "little") + text))
    except ValueError:
        raise _Unusual from None
    _expect(kind.kind in "iuf" and all(extent >= 0 for extent in shape))
    return kind, fortran, shape


def _expect(usual: bool) -> None:
    if not usual:
        raise _Unusual
