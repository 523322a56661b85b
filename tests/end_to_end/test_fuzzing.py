"""benchmarks/fuzzing.py, reduced: what is read is answered or refused in a sentence; no number is silently wrong."""

import pytest

from benchmarks.fuzz import folders
from benchmarks.fuzz.target import Target, Wrong, fuzz
from benchmarks.fuzzing import TARGETS, fuzz_all

SLOW = ("results folders", "studies of diagnosis")
"""Each input takes seconds."""


@pytest.mark.long
def test_nothing_that_is_read_ends_in_a_traceback_or_in_another_number():
    counts = fuzz_all([target for target in TARGETS if not target.name.startswith(SLOW)], inputs=140, seed=3)
    assert not [failure for count in counts.values() for failure in count.failures]
    assert sum(count.answers for count in counts.values()) > 50
    assert sum(count.sentences for count in counts.values()) > 50


def test_a_damaged_folder_is_read():
    count = fuzz(Target("kept", folders.damages(("pea_instances",)), folders.read, 1), 20, seed=3)
    assert not count.failures
    assert count.answers + count.sentences == 20


@pytest.mark.parametrize(
    ("behaviour", "kind"),
    [(lambda given: 1 / 0, "tracebacks"), (lambda given: _refuse(Wrong("other numbers")), "wrong")],
)
def test_what_fails_is_counted(behaviour, kind):
    count = fuzz(Target("bad", TARGETS[0].inputs, behaviour, 1), 5, seed=0)
    assert getattr(count, kind) == count.failed > 0
    assert len(count.failures) == 1


def _refuse(error):
    raise error
