# SPDX-License-Identifier: Apache-2.0
"""What diagnostic tasks report."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater import (
    CompositeDiagnosticTask,
    DiagnosticStatusWrapper,
    DiagnosticTask,
    DiagnosticTaskVector,
    FrequencyStatus,
    FrequencyStatusParam,
    FunctionDiagnosticTask,
    Heartbeat,
    TimeStampStatus,
    TimeStampStatusParam,
)
import pytest
from rclpy.clock import Clock
from rclpy.duration import Duration
from rclpy.time import Time

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class FixedClock:
    """A clock that always tells the same time."""

    def now(self) -> Time:
        """Return 100 s."""
        return Time(seconds=100)


def ran(task: DiagnosticTask) -> tuple[bytes, str, dict[str, str]]:
    """Return the level, the message and the values of a task."""
    status = task.run(DiagnosticStatusWrapper())
    return status.level, status.message, {each.key: each.value for each in status.values}


@pytest.mark.parametrize(
    ('first', 'second', 'level', 'message'),
    [
        ((OK, 'fine'), (OK, 'well'), OK, 'fine'),
        ((OK, 'fine'), (WARN, 'low'), WARN, 'low'),
        ((ERROR, 'broken'), (OK, 'well'), ERROR, 'broken'),
        ((WARN, 'low'), (ERROR, 'broken'), ERROR, 'low; broken'),
        ((ERROR, 'broken'), (WARN, 'low'), ERROR, 'broken; low'),
    ],
)
def test_summaries_are_merged(
    first: tuple[bytes, str], second: tuple[bytes, str], level: bytes, message: str
) -> None:
    """The higher level counts; messages are joined if neither is OK."""
    status, other = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
    status.summary(*first)
    other.summary(*second)
    status.mergeSummary(other)
    assert (status.level, status.message) == (level, message)
    status.clearSummary()
    assert (status.level, status.message) == (OK, '')


def test_values_and_levels_of_other_types() -> None:
    """Values become texts; levels may be numbers."""
    status = DiagnosticStatusWrapper()
    status.summary(2, 'broken')
    status.add('voltage', 21.5)
    assert status.level == ERROR
    assert [(each.key, each.value) for each in status.values] == [('voltage', '21.5')]


def test_several_tasks_with_one_status() -> None:
    """Their levels and messages are merged, and all values are there."""

    def low(status: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        status.summary(WARN, 'low')
        status.add('voltage', 20)
        return status

    both = CompositeDiagnosticTask('battery')
    both.addTask(Heartbeat())
    both.addTask(FunctionDiagnosticTask('voltage', low))
    assert both.getName() == 'battery'
    assert ran(both) == (WARN, 'low', {'voltage': '20'})
    both.tasks.pop()
    assert ran(both) == (OK, 'Alive', {})


def test_tasks_that_forget_to_return_the_status() -> None:
    """The error names the task."""
    with pytest.raises(TypeError, match="'voltage' returned None, but it must return the status"):
        ran(FunctionDiagnosticTask('voltage', lambda status: None))  # type: ignore[arg-type]


def test_tasks_are_added_and_removed() -> None:
    """Tasks are added themselves, or by name and function."""
    tasks = DiagnosticTaskVector()
    tasks.add(Heartbeat())
    tasks.add('voltage', lambda status: status)
    assert [each.getName() for each in tasks.tasks] == ['Heartbeat', 'voltage']
    assert tasks.removeByName('Heartbeat')
    assert not tasks.removeByName('Heartbeat')
    with pytest.raises(TypeError, match='a DiagnosticTask, or a name and a function'):
        tasks.add('voltage')


def test_frequencies() -> None:
    """Events per time are compared with the bounds, over the last reports."""
    now = [0.0]
    bounds = {'min': 4.0, 'max': 10.0}
    task = FrequencyStatus(FrequencyStatusParam(bounds, 0.1, 2), now_s=lambda: now[0])

    def after_events(count: int) -> tuple[bytes, str, dict[str, str]]:
        for _ in range(count):
            task.tick()
        now[0] += 1.0
        return ran(task)

    level, message, values = after_events(5)
    assert (level, message) == (OK, 'Frequency as desired.')
    assert values['Events in window'] == '5'
    assert float(values['Actual frequency (Hz)']) == 5.0
    assert float(values['Minimum acceptable frequency (Hz)']) == pytest.approx(3.6)
    assert after_events(0)[:2] == (WARN, 'Frequency too low.')  # 5 in 2 s
    level, message, values = after_events(30)
    assert (level, message) == (WARN, 'Frequency too high.')
    assert values['Duration of window (s)'] == '2.000000'
    assert values['Events since startup'] == '35'
    bounds['max'] = 20.0
    assert after_events(0)[:2] == (OK, 'Frequency as desired.')
    task.clear()
    assert after_events(0)[:2] == (ERROR, 'No events recorded.')


def test_ages_of_messages() -> None:
    """Messages from the future, old ones and ones without a time stamp are errors."""
    task = TimeStampStatus(TimeStampStatusParam(-1.0, 2.0), clock=FixedClock())
    assert ran(task)[:2] == (WARN, 'No data since last update.')
    task.tick(99.0)
    task.tick(Time(seconds=98, nanoseconds=500_000_000))
    level, message, values = ran(task)
    assert (level, message) == (OK, 'Timestamps are reasonable.')
    assert values['Earliest timestamp delay'] == '1.000000'
    assert values['Latest timestamp delay'] == '1.500000'
    task.tick(Time(seconds=102).to_msg())
    task.tick(97.0)
    task.tick(0)
    level, message, values = ran(task)
    assert level == ERROR
    assert message == (
        'Timestamps too far in future seen.; Timestamps too far in past seen.; '
        'Zero timestamp seen.'
    )
    assert values['Late diagnostic update count'] == '1'
    assert ran(task)[0] == WARN


def test_ages_by_the_clock_of_the_system() -> None:
    """Without another clock, that of the system counts, and 5 s are acceptable."""
    task = TimeStampStatus()
    task.tick(Clock().now() - Duration(seconds=1))
    assert ran(task)[0] == OK
    task.tick(Clock().now() - Duration(seconds=7))
    assert ran(task)[:2] == (ERROR, 'Timestamps too far in past seen.')
