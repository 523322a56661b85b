"""A pool loses no ticket, whatever one of them does, and leaves no process behind."""

import os
import pickle
import signal
import threading
import time
from pathlib import Path

import pytest

from hysteresis_bench.study.execution import cluster
from hysteresis_bench.study.execution.pool import Pool, Work
from tests.study.tickets import GOOD, alone, prepare
from tests.torture_distribution.misbehaviour import BAD, EXPECTED

WORK = Work(prepare, 1.0, (), alone)


def descendants(process: int) -> set[int]:
    found = set()
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == process and fields[0] != "Z":
            found |= {int(path.parent.name)} | descendants(int(path.parent.name))
    return found


def test_whatever_a_ticket_does_it_ends_alone_and_says_why():
    assert set(EXPECTED) == set(BAD)
    tickets = [each for bad in BAD for each in (bad, GOOD, "fork twice", "leaves state", GOOD)]
    before = descendants(os.getpid())
    with Pool(WORK, 2) as pool:
        ended = list(pool.run(tickets))
        time.sleep(0.3)  # the last one's children are being killed
        assert len(descendants(os.getpid()) - before) <= 1 + 2, "the template and its idle workers"
    assert descendants(os.getpid()) == before
    assert sorted(ticket for ticket, *_ in ended) == sorted(tickets)
    for ticket, outcome, status, reason in ended:
        if ticket in EXPECTED:
            assert outcome is None
            assert status == EXPECTED[ticket][0], ticket
            assert EXPECTED[ticket][1] in reason, ticket
            assert len(reason) <= 500
        else:
            assert status == "done", (ticket, reason)
    states = {outcome.found for ticket, outcome, *_ in ended if ticket == GOOD}
    assert len(states) == 1, "state left by one ticket was found by another"
    assert len({outcome.process for ticket, outcome, *_ in ended if ticket == GOOD}) <= 2, "good ones share workers"


def test_the_limit_does_not_count_the_preparation():
    with Pool(WORK, 1) as pool:
        ((_, _, status, _),) = pool.run(["slow to prepare"])
    assert status == "done"


@pytest.mark.parametrize("whom", ["template", "worker"])
def test_a_process_killed_from_outside_costs_the_tickets_it_had(whom):
    with Pool(Work(prepare, 60.0, (), alone), 2) as pool:
        template = pool._template._process.pid

        def kill() -> None:
            workers = descendants(template)
            while len(workers) < 2:
                workers = descendants(template)
            os.kill(template if whom == "template" else max(workers), signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        ended = list(pool.run(["slow to prepare", "slow to prepare", GOOD, GOOD]))
        killer.join()
    statuses = sorted(status for _, _, status, _ in ended)
    assert statuses == {"template": ["done", "done", "killed", "killed"], "worker": ["done"] * 3 + ["killed"]}[whom]


def test_the_pool_of_a_dask_worker_ends_where_no_ticket_comes(monkeypatch):
    monkeypatch.setattr(cluster, "IDLE", 0.5)
    monkeypatch.setattr(cluster, "_memory", lambda: 2 << 30)
    before, work = descendants(os.getpid()), pickle.dumps(WORK)
    for _ in range(2):  # it is opened again for what comes later
        assert [cluster.carried_out(work, GOOD)[1] for _ in range(2)] == ["done", "done"]
        assert descendants(os.getpid()) > before
        deadline = time.monotonic() + 30.0
        while descendants(os.getpid()) != before and time.monotonic() < deadline:
            time.sleep(0.1)
        assert descendants(os.getpid()) == before
