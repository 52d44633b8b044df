# SPDX-License-Identifier: Apache-2.0
"""
Wait for events of a process and assert its output.

Each function accepts the launch context and the action of the process; for output, the action
must have been created with cached_output=True. Validators return whether the output is valid, or
raise an AssertionError. Without a timeout, functions wait until the process ends. Asynchronous
tests await the functions; other tests use those with the suffix `_sync`, which have the same
arguments and block; from the event loop of the launch, they raise a RuntimeError.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from functools import partial, wraps
from inspect import signature
from typing import Any, Optional, ParamSpec, TYPE_CHECKING, TypeVar

from launch_pytest.tools._process_watch import until

if TYPE_CHECKING:
    from launch import LaunchContext
    from launch.actions import ExecuteProcess

__tracebackhide__ = True  # for pytest

ParametersT = ParamSpec('ParametersT')
ResultT = TypeVar('ResultT')
Validate = Callable[[str], Any]

__all__ = [
    'assert_output',
    'assert_output_sync',
    'assert_stderr',
    'assert_stderr_sync',
    'assert_stdout',
    'assert_stdout_sync',
    'wait_for_exit',
    'wait_for_exit_sync',
    'wait_for_output',
    'wait_for_output_sync',
    'wait_for_start',
    'wait_for_start_sync',
    'wait_for_stderr',
    'wait_for_stderr_sync',
    'wait_for_stdout',
    'wait_for_stdout_sync',
]


async def wait_for_start(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    timeout: Optional[float] = None,
) -> bool:
    """
    Wait until a process has started, and return whether it has.

    Parameters
    ----------
    launch_context
        The context of the launch.
    execute_process_action
        The action of the process.
    timeout
        The timeout in s; None waits until the process ends.

    """

    def was_started() -> bool:
        return 'pid' in (execute_process_action.process_details or {})

    return await until(launch_context, execute_process_action, was_started, timeout)


async def wait_for_exit(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    timeout: Optional[float] = None,
) -> bool:
    """
    Wait until a process has ended, and return whether it has.

    Parameters
    ----------
    launch_context
        The context of the launch.
    execute_process_action
        The action of the process.
    timeout
        The timeout in s; None waits until the process ends.

    """

    def has_ended() -> bool:
        return execute_process_action.return_code is not None

    return await until(launch_context, execute_process_action, has_ended, timeout)


async def wait_for_stdout(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: Optional[float] = None,
) -> bool:
    """
    Wait until the standard output of a process is valid, and return whether it is.

    Parameters
    ----------
    launch_context
        The context of the launch.
    execute_process_action
        The action of the process, created with `cached_output=True`.
    validate_output
        Called with all output so far. False or an AssertionError means not yet, None valid.
    timeout
        The timeout in s; None waits until the process ends.

    Raises
    ------
    RuntimeError
        The output is not cached.

    """
    check = partial(_is_right, execute_process_action.get_stdout, validate_output)
    return await until(launch_context, execute_process_action, check, timeout)


async def wait_for_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: Optional[float] = None,
) -> bool:
    """
    Wait until the standard error of a process is valid, and return whether it is.

    Parameters
    ----------
    launch_context, execute_process_action, validate_output, timeout
        As for `wait_for_stdout`.

    Raises
    ------
    RuntimeError
        The output is not cached.

    """
    check = partial(_is_right, execute_process_action.get_stderr, validate_output)
    return await until(launch_context, execute_process_action, check, timeout)


async def assert_stdout(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: Optional[float] = None,
) -> None:
    """
    Wait until the standard output of a process is valid, and fail if it is not.

    Parameters
    ----------
    launch_context, execute_process_action, validate_output, timeout
        As for `wait_for_stdout`.

    Raises
    ------
    AssertionError
        The error of the validation, or one that shows the output.
    RuntimeError
        The output is not cached.

    """
    if not await wait_for_stdout(launch_context, execute_process_action, validate_output, timeout):
        _fail(
            execute_process_action,
            'standard output',
            execute_process_action.get_stdout(),
            validate_output,
        )


async def assert_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: Optional[float] = None,
) -> None:
    """
    Wait until the standard error of a process is valid, and fail if it is not.

    Parameters
    ----------
    launch_context, execute_process_action, validate_output, timeout
        As for `wait_for_stdout`.

    Raises
    ------
    AssertionError
        The error of the validation, or one that shows the output.
    RuntimeError
        The output is not cached.

    """
    if not await wait_for_stderr(launch_context, execute_process_action, validate_output, timeout):
        _fail(
            execute_process_action,
            'standard error output',
            execute_process_action.get_stderr(),
            validate_output,
        )


def _is_right(get_output: Callable[[], str], validate_output: Validate) -> bool:
    """Whether an output is valid; a validator that returns None accepts it."""
    try:
        verdict = validate_output(get_output())
    except AssertionError:
        return False
    return verdict is None or bool(verdict)


def _fail(action: ExecuteProcess, what: str, output: str, validate_output: Validate) -> None:
    """Raise the AssertionError of the validation, or one that shows the output."""
    validate_output(output)
    name = (action.process_details or {}).get('name', action)
    raise AssertionError(f"the {what} of '{name}' is not what the test waits for:\n{output}")


def _blocking(
    function: Callable[ParametersT, Coroutine[Any, Any, ResultT]],
) -> Callable[ParametersT, ResultT]:
    """Return the variant of a function that blocks a test which is not asynchronous."""

    @wraps(function)
    def call(*args: ParametersT.args, **kwargs: ParametersT.kwargs) -> ResultT:
        context = signature(function).bind(*args, **kwargs).arguments['launch_context']
        return _run_in_launch(context, function(*args, **kwargs))

    call.__name__ = call.__qualname__ = f'{function.__name__}_sync'
    return call


def _run_in_launch(
    launch_context: LaunchContext, coroutine: Coroutine[Any, Any, ResultT]
) -> ResultT:
    """Run a coroutine in the event loop of the launch, from another thread."""
    loop = launch_context.asyncio_loop
    if loop is None:  # the launch has ended, so the coroutine will not wait
        return asyncio.run(coroutine)
    if loop is _running_loop():
        coroutine.close()
        raise RuntimeError(
            'functions with _sync cannot be used in asynchronous tests, where they would keep '
            'the launch from going on: await the function without _sync instead'
        )
    return asyncio.run_coroutine_threadsafe(coroutine, loop).result()


def _running_loop() -> Optional[asyncio.AbstractEventLoop]:
    """Return the event loop that runs in this thread, if there is one."""
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None


wait_for_start_sync = _blocking(wait_for_start)
wait_for_exit_sync = _blocking(wait_for_exit)
wait_for_stdout_sync = _blocking(wait_for_stdout)
wait_for_stderr_sync = _blocking(wait_for_stderr)
assert_stdout_sync = _blocking(assert_stdout)
assert_stderr_sync = _blocking(assert_stderr)

wait_for_output = wait_for_stdout
wait_for_output_sync = wait_for_stdout_sync
assert_output = assert_stdout
assert_output_sync = assert_stdout_sync
