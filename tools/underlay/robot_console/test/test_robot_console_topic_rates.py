# SPDX-License-Identifier: Apache-2.0
"""How often topics come, and what their messages say."""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Time
import pytest
from rclpy.serialization import serialize_message
from robot_console.topic_rates import Measured, Survey
from robot_console.topic_watch import decoded, has_lists_of_messages, RateWindow
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Float64MultiArray, String
from visualization_msgs.msg import Marker


def heard(rate_hz: float, count: int, size: int = 100) -> RateWindow:
    """Return a window after some messages, the last one at 0 s."""
    window = RateWindow()
    for number in range(count):
        window.add((number - count + 1) / rate_hz, size)
    return window


def test_rate() -> None:
    """The rate and the flow are those of the newest messages."""
    window = heard(50.0, 100)
    assert window.rate_hz(0.01) == pytest.approx(50.0)
    assert window.bytes_per_s(0.01) == pytest.approx(5000.0)
    assert window.age_s(0.25) == 0.25
    assert heard(0.2, 3).rate_hz(1.0) == pytest.approx(0.2)


def test_silence() -> None:
    """The rate of a topic that falls silent sinks, and is not known after a while."""
    window = heard(50.0, 100)
    assert window.rate_hz(2.0) == pytest.approx(99 / 3.98)
    assert window.rate_hz(11.0) is None
    assert heard(1.0, 1).rate_hz(0.0) is None and RateWindow().age_s(0.0) is None


def test_clock_goes_back() -> None:
    """A clock that goes back starts anew."""
    window = heard(50.0, 100)
    window.add(-100.0, 1)
    window.add(-99.0, 1)
    assert window.rate_hz(-99.0) == pytest.approx(1.0)


def test_same_time() -> None:
    """Messages that come at the same moment have no rate, and divide nothing by zero."""
    window = RateWindow()
    for _ in range(3):
        window.add(1.0, 10)
    assert window.rate_hz(1.0) is None and window.bytes_per_s(1.0) is None


def test_survey() -> None:
    """A few topics are measured at a time, fast ones only for a moment, all after a while."""
    topics = [f'/t{number}' for number in range(10)]
    survey = Survey()
    first = survey.plan(topics, 0.0)
    assert len(first) == 4
    fast = min(first)
    enough = [survey.hear(fast, number / 100.0, 10) for number in range(30)]
    assert not any(enough[:-1]) and enough[-1]
    assert fast not in survey.plan(topics, 0.5)
    assert survey.measured == {fast: Measured(pytest.approx(100.0), True)}
    for step in range(1, 10):
        survey.plan(topics, step * 3.0)
    assert set(survey.measured) == set(topics)
    assert survey.measured['/t9'] == Measured(None, False)


def test_survey_of_large_messages() -> None:
    """Large messages are not listened to for long, and those of unknown topics not at all."""
    survey = Survey()
    survey.plan(['/image'], 0.0)
    assert not survey.hear('/image', 0.0, 6_000_000)
    assert survey.hear('/image', 0.1, 6_000_000)
    assert survey.hear('/unknown', 0.0, 1)
    survey.plan([], 0.2)
    assert survey.plan(['/image'], 0.3) == {'/image'}


@pytest.mark.parametrize(
    ('message', 'has_lists'), [(JointState(), False), (Image(), False), (Marker(), True)]
)
def test_lists_of_messages(message: Any, has_lists: bool) -> None:
    """Messages with lists of messages are told from those with lists of numbers."""
    assert has_lists_of_messages(type(message)) == has_lists


def test_decoded() -> None:
    """A message is shown as YAML; long lists and texts are cut."""
    image = Image(width=2, data=bytes(1000), encoding='rgb8')
    text = decoded(serialize_message(image), Image)
    assert 'width: 2' in text and text.count('- 0') == 64 and '...' in text
    assert decoded(serialize_message(String(data='a' * 999)), String).count('a') < 80
    assert '.nan' in decoded(
        serialize_message(Float64MultiArray(data=[float('nan')])), Float64MultiArray
    )


def test_too_large() -> None:
    """A message that takes long to decode is not shown, which is said with both sizes."""
    text = decoded(bytes(400_000), Marker)
    assert text.startswith('A message of 400.00 KB is not shown as text') and '300.00 KB' in text
    assert decoded(serialize_message(Time(sec=3)), Time).startswith('sec: 3')
