# SPDX-License-Identifier: Apache-2.0
"""Check when the alarm speaks."""

from __future__ import annotations

import math

from temperature_monitor.heat_alarm import HeatAlarm, Notice


def test_warns_above_the_threshold() -> None:
    """Every reading above the threshold is a warning."""
    alarm = HeatAlarm(25.0)
    warning = Notice('26.4 °C is above 25.0 °C', is_warning=True)
    assert [alarm.judge(26.4), alarm.judge(26.4)] == [warning, warning]


def test_silent_below() -> None:
    """Nothing is said about normal readings, of which the threshold is one."""
    alarm = HeatAlarm(25.0)
    assert [alarm.judge(20.0), alarm.judge(25.0)] == [None, None]


def test_back_to_normal_is_told_once() -> None:
    """The return to normal is told, but only once."""
    alarm = HeatAlarm(25.0)
    alarm.judge(26.0)
    notice = Notice('Back to normal: 24.0 °C is not above 25.0 °C', is_warning=False)
    assert [alarm.judge(24.0), alarm.judge(24.0)] == [notice, None]


def test_threshold_can_change() -> None:
    """The next reading is judged by the new threshold."""
    alarm = HeatAlarm(25.0)
    alarm.threshold_celsius = 28.0
    assert alarm.judge(27.0) is None


def test_broken_thermometer() -> None:
    """A reading that is not a number is a warning, and does not count as normal."""
    alarm = HeatAlarm(25.0)
    alarm.judge(26.0)
    notice = alarm.judge(math.nan)
    assert notice is not None and notice.is_warning and 'broken' in notice.text
    assert alarm.judge(24.0) is not None
