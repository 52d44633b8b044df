# SPDX-License-Identifier: Apache-2.0
"""Run launches in which some actions are tests."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
import sys
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.actions import ExecuteLocal, RegisterEventHandler
from launch.actions import Shutdown as ShutdownAction
from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO
from launch_testing.tools.text import build_text_match, Expected

if TYPE_CHECKING:
    from launch import Action, LaunchDescription, LaunchService

OutputTest = Union[Expected, Callable[[str], Any]]


class _State(Enum):
    """The state of a test."""

    ARMED = 'has not ended'
    SUCCEEDED = 'succeeded'
    FAILED = 'failed'


class LaunchTestService:
    """Service that adds fixtures and tests to a launch description and reports the results."""

    def __init__(self) -> None:
        """Create a service without tests."""
        self._tests: dict[str, _State] = {}
        self._reasons: dict[str, str] = {}

    # Fixtures and tests.

    def add_fixture_action(
        self,
        launch_description: LaunchDescription,
        action: Action,
        required: bool = False,
    ) -> Action:
        """
        Add a fixture that the tests require to a launch description.

        Parameters
        ----------
        launch_description
            The launch description to add to.
        action
            The fixture action.
        required
            Whether a premature end of the action is a failure, which shuts the launch down.

        Returns
        -------
        Action
            The same action.

        """
        if required:
            self._require(launch_description, action)
        launch_description.add_action(action)
        return action

    def add_test_action(self, launch_description: LaunchDescription, action: Action) -> Action:
        """
        Add a test: a process, or an action with a coroutine.

        The test succeeds if its exit code is 0, or if its coroutine raises no exception. The
        launch is shut down when all tests have ended or one has failed.

        Parameters
        ----------
        launch_description
            The launch description to add to.
        action
            The test action.

        Returns
        -------
        Action
            The same action.

        """
        name = self._arm(f'test {len(self._tests) + 1}')
        if isinstance(action, ExecuteLocal):
            handler: Any = OnProcessExit(
                target_action=action,
                on_exit=lambda event, _: self._end(
                    name, event.returncode == 0, f'its exit code is {event.returncode}'
                ),
            )
        else:
            handler = OnExecutionComplete(
                target_action=action,
                on_completion=lambda event, _: self._end_of_action(name, event.action),
            )
        launch_description.add_action(RegisterEventHandler(handler))
        launch_description.add_action(action)
        return action

    def add_output_test(
        self,
        launch_description: LaunchDescription,
        action: ExecuteLocal,
        output_test: OutputTest,
        test_suffix: str = 'output',
        output_filter: Optional[Callable[[str], str]] = None,
        side_effect: Optional[str] = None,
    ) -> Action:
        """
        Add a test of the standard output of a process.

        Parameters
        ----------
        launch_description
            The launch description, which contains the process.
        action
            The action of the process.
        output_test
            A string, a regular expression or a predicate of the output, or a list of those for
            lines.
        test_suffix
            The name of the test.
        output_filter
            Filter that is applied to the output first.
        side_effect
            `shutdown` shuts the launch down as soon as the output is found, regardless of other
            tests.

        Returns
        -------
        Action
            The same action.

        Raises
        ------
        ValueError
            The side effect is unknown.

        """
        if side_effect not in (None, 'shutdown'):
            raise ValueError(f"side_effect is None or 'shutdown', not {side_effect!r}")
        name = self._arm(f'{test_suffix} {len(self._tests) + 1}')
        matches, text = build_text_match(output_test), ''

        def check(event: Any) -> Any:
            nonlocal text
            text += event.text.decode('utf-8', 'replace')
            seen = text if output_filter is None else output_filter(text)
            if self._tests[name] is not _State.ARMED or not matches(seen):
                return None
            shutdown = self._end(name, True)
            return ShutdownAction(reason='output found') if side_effect else shutdown

        def fail(event: Any, context: Any) -> Any:
            if self._tests[name] is _State.ARMED:
                return self._end(name, False, f'the process has ended; it wrote:\n{text}')
            return None

        launch_description.entities[:0] = [
            RegisterEventHandler(OnProcessIO(target_action=action, on_stdout=check)),
            RegisterEventHandler(OnProcessExit(target_action=action, on_exit=fail)),
        ]
        return action

    # Results.

    def run(self, launch_service: LaunchService, *args: Any, **kwargs: Any) -> int:
        """
        Run a launch and report failed tests on the standard error.

        Parameters
        ----------
        launch_service
            The service that includes the launch description.
        *args, **kwargs
            The arguments of its `run`.

        Returns
        -------
        int
            0 if the launch and all tests succeeded.

        """
        return self._result(launch_service.run(*args, **kwargs))

    async def run_async(self, launch_service: LaunchService, *args: Any, **kwargs: Any) -> int:
        """
        Run a launch in the running event loop and report failed tests.

        Parameters
        ----------
        launch_service
            The service that includes the launch description.
        *args, **kwargs
            The arguments of its `run_async`.

        Returns
        -------
        int
            0 if the launch and all tests succeeded.

        """
        return self._result(await launch_service.run_async(*args, **kwargs))

    def _result(self, status: int) -> int:
        failed = [name for name, state in self._tests.items() if state is not _State.SUCCEEDED]
        for name in failed:
            reason = self._reasons.get(name, 'the launch ended before')
            print(f'{name} {self._tests[name].value}: {reason}', file=sys.stderr)
        return status or int(bool(failed))

    def _arm(self, name: str) -> str:
        self._tests[name] = _State.ARMED
        return name

    def _end(self, name: str, is_success: bool, reason: str = '') -> Optional[Action]:
        """Record a test result; return a shutdown action after a failure or the last test."""
        self._tests[name] = _State.SUCCEEDED if is_success else _State.FAILED
        if not is_success:
            self._reasons[name] = reason
            return ShutdownAction(reason=f'{name} failed')
        if _State.ARMED in self._tests.values():
            return None
        return ShutdownAction(reason='all tests have succeeded')

    def _end_of_action(self, name: str, action: Action) -> Optional[Action]:
        future = action.get_asyncio_future()
        if future is None or not future.done():
            return self._end(name, True)
        if future.cancelled():
            return self._end(name, False, 'it was cancelled')
        error = future.exception()
        return self._end(name, error is None, repr(error))

    def _require(self, launch_description: LaunchDescription, action: Action) -> None:
        """Add a failure if a required fixture ends before the tests."""

        def fail(*args: Any) -> Any:
            if _State.ARMED not in self._tests.values():
                return None
            name = self._arm('required fixture')
            return self._end(name, False, f'{action!r} ended before the tests')

        handler: Any = (
            OnProcessExit(target_action=action, on_exit=fail)
            if isinstance(action, ExecuteLocal)
            else OnExecutionComplete(target_action=action, on_completion=fail)
        )
        launch_description.add_action(RegisterEventHandler(handler))
