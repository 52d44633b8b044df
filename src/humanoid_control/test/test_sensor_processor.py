# SPDX-License-Identifier: Apache-2.0
"""Check the reports of the first joint."""

from __future__ import annotations

from humanoid_control.sensor_processor import JointReporter
import pytest


def test_line() -> None:
    """The first joint is reported with three decimals."""
    report = JointReporter(1.0).report(['left_shoulder', 'left_elbow'], [0.0411, 0.5], 0.0)
    assert report == 'left_shoulder: 0.041 rad'


def test_at_most_once_a_period() -> None:
    """Within a period there is one report; then comes the next."""
    reporter = JointReporter(1.0)
    times_s = [0.0, 0.02, 0.98, 1.0, 1.5, 2.1]
    due = [now_s for now_s in times_s if reporter.report(['a'], [0.0], now_s)]
    assert due == [0.0, 1.0, 2.1]


@pytest.mark.parametrize(('names', 'positions'), [([], []), (['a'], []), ([], [0.1])])
def test_nothing_to_report(names: list[str], positions: list[float]) -> None:
    """Incomplete messages are passed over, and do not delay the next report."""
    reporter = JointReporter(1.0)
    assert reporter.report(names, positions, 0.0) is None
    assert reporter.report(['a'], [0.1], 0.1) == 'a: 0.100 rad'
