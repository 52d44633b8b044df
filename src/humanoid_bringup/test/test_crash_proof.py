# SPDX-License-Identifier: Apache-2.0
"""Check what is started anew, and with which values."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from humanoid_bringup.crash_proof import crash_proof, Once
from launch import LaunchContext
from launch.actions import TimerAction
from launch.substitutions import LaunchConfiguration, TextSubstitution

CONTEXT: Any = SimpleNamespace(is_shutdown=False)


def ended(made: list[Any], status: int, context: Any = CONTEXT) -> Any:
    """Return what follows when the newest of some nodes ends."""
    return made[-1](SimpleNamespace(returncode=status), context)


def test_a_crash_brings_it_back_some_times() -> None:
    """What was closed stays closed, and so does what crashes again and again."""
    made: list[Any] = []

    def make(on_exit: Any) -> Any:
        made.append(on_exit)
        return TimerAction(period=0.0, actions=[])

    crash_proof(make, most=2)
    assert ended(made, 0) is None
    assert ended(made, -9, SimpleNamespace(is_shutdown=True)) is None
    for status in (-9, 1):
        (timer,) = ended(made, status)
        assert isinstance(timer, TimerAction)
    assert len(made) == 3
    assert ended(made, -9) is None


def test_values_are_those_of_the_scope_in_which_it_was_included() -> None:
    """Later the arguments of the launch file are no longer known."""
    context = LaunchContext()
    context.launch_configurations['prefix'] = 'left_'
    name = Once(LaunchConfiguration('prefix'), TextSubstitution(text='arm'))
    assert name.perform(context) == 'left_arm'
    del context.launch_configurations['prefix']
    assert name.perform(context) == 'left_arm'
