"""What is done about faults of records before a fit: rows that were lost are left out, and what an output is stuck at,
and where the input turned in a gap until it has turned twice; what comes after a jump gets an offset of its own, spikes
are bridged."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.data.faults.dropouts import dropouts_in_words, without_dropouts
from hysteresis_bench.data.faults.hidden_turns import hidden_turns_in_words, parted_at_hidden_turns
from hysteresis_bench.data.faults.jumps import jumps_in_words, parted_at_jumps
from hysteresis_bench.data.faults.spikes import spikes_in_words, without_spikes
from hysteresis_bench.data.faults.stuck import parted_where_stuck, stuck_in_words
from hysteresis_bench.signals import Dataset, Record


def without_faults(dataset: Dataset, effects: Collection[str] = (registry.RECORD_OFFSET,)) -> Dataset:
    """The data set that is fitted with these effects, by name, and a note on every fault that is mended: jumps only
    where an effect gives every record an offset of its own. What is stuck ends in a leap, which would be taken for a
    jump; and a step for half of a spike."""
    sound = parted_at_hidden_turns(parted_where_stuck(without_dropouts(dataset)))
    return without_spikes(parted_at_jumps(sound) if registry.RECORD_OFFSET in effects else sound)


def still(record: Record, purpose: str) -> str:
    """A sentence on a record whose input or scored output never moves; empty where both do.  purpose : a verb"""
    moved = {"input": np.ptp(record.input), "output": np.ptp(record.measured)}
    constant = next((column for column, by in moved.items() if not by > 0.0), "")
    return constant and f"record {record.name}: the {constant} is constant; there is nothing to {purpose}."


def jumps_told(record: Record) -> str:
    """Where the output of a record jumps, and what helps; empty without any."""
    words = jumps_in_words(record)
    return words and (
        f"{words} `diagnose` takes what comes after for a record of its own; so does `fit` with --effect "
        f"{registry.RECORD_OFFSET}, which gives it an offset of its own."
    )


def counted(records: Sequence[Record]) -> tuple[str, ...]:
    """What records say that no device did, or leave out, and that an error counts where nothing is mended."""
    looks = (dropouts_in_words, stuck_in_words, hidden_turns_in_words, jumps_in_words, spikes_in_words)
    found = (words for record in records if record.output is not None for look in looks if (words := look(record)))
    return tuple(f"{words} The errors count it." for words in found)
