"""The base of everything that a file in TOML says: an unknown key is a fault, and nothing changes afterwards."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Strict(BaseModel):
    """A checked part of a file."""

    model_config = ConfigDict(extra="forbid", frozen=True)
