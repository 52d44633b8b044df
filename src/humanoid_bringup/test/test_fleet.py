# SPDX-License-Identifier: Apache-2.0
"""Check the names of the robots, and launch arguments that are whole numbers."""

from __future__ import annotations

from humanoid_bringup.launch_arguments import robot_namespaces, WholeNumber
from launch import LaunchContext
import pytest


def test_names() -> None:
    """Robots are counted from one."""
    assert robot_namespaces('3') == ['robot1', 'robot2', 'robot3']


@pytest.mark.parametrize(
    'count', ['0', '-1', 'x', '', '2.5', '1000', '51', '1_0', '\N{FULLWIDTH DIGIT TWO}']
)
def test_refused(count: str) -> None:
    """A count that makes no fleet is refused, with what to pass instead."""
    with pytest.raises(ValueError, match=f"'robots' is '{count}', but must be a whole number"):
        robot_namespaces(count)


def test_a_port_is_read_before_anything_starts() -> None:
    """One that cannot be is a sentence."""
    context, port = LaunchContext(), WholeNumber('port', range(65536), 8090)
    context.launch_configurations['port'] = '8080'
    assert port.perform(context) == '8080'
    for text in ('abc', '-1', '99999'):
        context.launch_configurations['port'] = text
        with pytest.raises(ValueError, match=f"'port' is '{text}', but must be a whole number"):
            port.perform(context)
