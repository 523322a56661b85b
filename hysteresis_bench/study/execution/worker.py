"""A worker: tickets come in, outcomes go out, and an exception goes out as text."""

from __future__ import annotations

import socket
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hysteresis_bench.errors import UserError, told
from hysteresis_bench.study.execution.messages import receive, send

BEGUN = "begun"
"""What a worker says when a ticket's preparation (imports, compilation, data) is over: its time runs from here."""

Prepare = Callable[[Any], Callable[[], Any]]
"""prepare(ticket) -> what carries it out. It travels to the workers by its name."""


@dataclass(frozen=True)
class Failure:
    """A ticket that came to no outcome of its own."""

    status: str
    reason: str


def work(connection: socket.socket, prepare: Prepare) -> None:
    """Carry out the tickets that arrive, one after the other, until no more come."""
    while True:
        try:
            ticket = receive(connection)
        except EOFError:
            return
        answer = carried_out(connection, prepare, ticket)
        try:
            send(connection, answer)
        except OSError:
            return
        except Exception as error:  # an outcome that cannot be pickled
            send(connection, Failure("raised", told(error)))


def carried_out(connection: socket.socket, prepare: Prepare, ticket: Any) -> Any:
    """The outcome of a ticket, or a Failure, whatever a plugin raises."""
    try:
        try:
            search = prepare(ticket)
        except UserError as error:  # what a machine lacks, such as the data, is not the plugin's fault
            return Failure("not-started", told(error))
        send(connection, BEGUN)
        return search()
    except MemoryError:
        return Failure("out-of-memory", "needed more memory than its share of the machine")
    except BaseException as error:  # SystemExit and KeyboardInterrupt, too, end the ticket and nothing else
        return Failure("raised", told(error))
