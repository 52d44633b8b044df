# SPDX-License-Identifier: Apache-2.0
"""What is recorded of messages that had arrived, but not been taken, when the signal came."""

from __future__ import annotations

from collections.abc import Callable
import time
from types import SimpleNamespace
from typing import Any

from ros2bag.api import recorder as module
from ros2bag.api.common_arguments import TopicFilter
from ros2bag.api.control import PauseSwitch
from ros2bag.api.recorder import Recorder

SECOND_NS = 1_000_000_000


class Busy:
    """A node in which other work comes between any two messages that wait."""

    def __init__(self, waiting: int, monkeypatch: Any) -> None:
        """Give the recorder's module a clock that only this node lets go on."""
        self.begin_ns = time.time_ns()
        self.steady_s = 0.0
        self.waiting = waiting
        self.late = 0
        self.receive: Callable[[bytes, dict[str, int]], None]
        clock = SimpleNamespace(monotonic=lambda: self.steady_s, time_ns=lambda: self.begin_ns)
        monkeypatch.setattr(module, 'time', clock)
        self._is_other_due = True

    def spin_once(self, timeout_s: float) -> None:
        """Do one thing that is due: something else, an old message, or one that comes now."""
        self.steady_s += 0.001
        self._is_other_due = not self._is_other_due
        if self._is_other_due:
            return
        self.late += not self.waiting
        arrived_ns = self.begin_ns + (SECOND_NS if not self.waiting else -SECOND_NS)
        self.waiting = max(0, self.waiting - 1)
        self.receive(
            b'',
            {
                'received_timestamp': arrived_ns,
                'source_timestamp': arrived_ns,
                'publication_sequence_number': 1,
            },
        )


def test_all_that_had_arrived_is_recorded_and_no_more(monkeypatch: Any) -> None:
    """Neither other work nor a slow machine ends it, and a topic that goes on does not last."""
    node = Busy(2000, monkeypatch)
    written: list[Any] = []
    writer = SimpleNamespace(write=written.append)
    switch = PauseSwitch(is_paused=False, say=print)
    recorder = Recorder(node, writer, TopicFilter(everything=True), switch)  # type: ignore
    node.receive = recorder._receiver('/ticks')
    recorder.take_rest()
    assert (len(written), node.waiting) == (2000, 0)
    assert node.late < 5
