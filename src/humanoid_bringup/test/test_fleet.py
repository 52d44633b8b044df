# SPDX-License-Identifier: Apache-2.0
"""Check the names of the robots."""

from __future__ import annotations

from humanoid_bringup.launch_arguments import robot_namespaces
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
