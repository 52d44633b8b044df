# SPDX-License-Identifier: Apache-2.0
"""Check that the full system lets assistants in if it is told to."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
import pytest

pytest.importorskip('mcp')

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'full_system.launch.py'
WITHOUT = ('gui', 'navigation', 'perception', 'voice', 'planner', 'use_controller', 'manipulation')
ARGUMENTS = ('backend:=mock', *(f'{name}:=false' for name in WITHOUT))


def test_assistants_have_an_address_of_their_own() -> None:
    """The names that it shares with the page and the planner do not disturb it."""
    with (
        ros_sandbox(),
        running_launch_file(
            LAUNCH_FILE, *ARGUMENTS, 'assistants:=true', 'assistants_port:=0', 'confirm:=motion'
        ) as program,
    ):
        program.wait_for_output('/mcp', 100.0)
    assert 'http://127.0.0.1:' in program.output and 'Traceback' not in program.output
