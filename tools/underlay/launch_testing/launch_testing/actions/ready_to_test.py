# SPDX-License-Identifier: Apache-2.0
"""Launch action that signals that the tests can start."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch import Action, Event

if TYPE_CHECKING:
    from launch import LaunchContext


class TestsMayBegin(Event):
    """
    A ReadyToTest action was visited.

    Parameters
    ----------
    action
        The action that was visited.

    """

    __test__ = False
    name = 'launch_testing.TestsMayBegin'

    def __init__(self, action: object) -> None:
        self.action = action


class ReadyToTest(Action):
    """Lets the tests begin; of several, all must have been visited."""

    def describe(self) -> str:
        """Return a short human-readable description."""
        return 'ReadyToTest()'

    def execute(self, context: LaunchContext) -> None:
        """
        Emit the event that starts the tests.

        Parameters
        ----------
        context
            The context of the launch under test.

        """
        context.emit_event_sync(TestsMayBegin(self))
