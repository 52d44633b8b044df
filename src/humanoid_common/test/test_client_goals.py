# SPDX-License-Identifier: Apache-2.0
"""Test that an answer is asked for again."""

from __future__ import annotations

from humanoid_common.client_goals import ResultRequest
import pytest
from rclpy.task import Future


class Handle:
    """A goal whose answers come when a test says so."""

    def __init__(self) -> None:
        """Begin without a request."""
        self.answers: list[Future] = []

    def get_result_async(self) -> Future:
        """Take note of a request."""
        self.answers.append(Future())
        return self.answers[-1]


@pytest.mark.parametrize('answered', [0, 1, 2])
def test_any_answer_will_do(answered: int) -> None:
    """Also one to an earlier request, and the first one is not asked for twice at once."""
    handle, clock_s = Handle(), [0.0]
    end = ResultRequest(handle, lambda: clock_s[0])
    for clock_s[0] in (0.1, 4.9, 5.1, 5.2, 10.0, 10.3):
        assert not end.done()
    assert len(handle.answers) == 3
    handle.answers[answered].set_result('answer')
    clock_s[0] = 100.0
    assert end.done() and end.result() == 'answer'
    assert len(handle.answers) == 3
