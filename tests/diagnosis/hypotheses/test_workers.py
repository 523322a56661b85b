"""Several questions at once: who answers them after the end, and who is stopped with them."""

import multiprocessing
import time

from hysteresis_bench.diagnosis.hypotheses.workers import Workers


class Squares:
    def squared(self, value: int) -> int:
        return value * value


QUESTIONS = [("squared", value) for value in range(4)]


def test_questions_after_the_end_are_answered_too():
    with Workers[int](Squares(), jobs=2) as workers:
        assert workers.map(QUESTIONS) == [0, 1, 4, 9]
    assert workers.map(QUESTIONS) == [0, 1, 4, 9]


def test_an_interruption_ends_no_process_of_the_caller():
    own = multiprocessing.get_context("fork").Process(target=time.sleep, args=(30,))
    own.start()
    try:
        workers = Workers[int](Squares(), jobs=2)
        workers.map(QUESTIONS)
        pool = {*multiprocessing.active_children()} - {own}
        workers.__exit__(KeyboardInterrupt, KeyboardInterrupt(), None)
        assert pool
        assert not any(process.is_alive() for process in pool)
        assert own.is_alive()
    finally:
        own.terminate()
        own.join()
