# SPDX-License-Identifier: Apache-2.0
"""The action that runs a coroutine of the launch file."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Iterable, Mapping
from typing import Any, Optional, TYPE_CHECKING

from launch.action import Action
from launch.event_handlers.on_shutdown import OnShutdown

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext


class OpaqueCoroutine(Action):
    """
    Action that runs a coroutine; the launch stays until it is done, and cancels it on shutdown.

    Parameters
    ----------
    coroutine
        The function, which is called with the context and `args`, and returns the coroutine.
    args, kwargs
        Further positional and keyword arguments of the function.
    ignore_context
        Whether the function is called without the context.
    **left_over_kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        `coroutine` is not callable.

    """

    def __init__(
        self,
        *,
        coroutine: Callable[..., Coroutine[Any, Any, Any]],
        args: Optional[Iterable[Any]] = None,
        kwargs: Optional[Mapping[str, Any]] = None,
        ignore_context: bool = False,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(coroutine):
            raise TypeError(
                f"OpaqueCoroutine expected a coroutine function, but got '{coroutine!r}'"
            )
        self.__coroutine = coroutine
        self.__args = tuple(args or ())
        self.__kwargs = dict(kwargs or {})
        self.__ignore_context = ignore_context
        self.__task: Optional[asyncio.Task[Any]] = None

    def execute(self, context: LaunchContext) -> None:
        """
        Start the coroutine as a task of the launch.

        Parameters
        ----------
        context
            The context of a running launch.

        Raises
        ------
        RuntimeError
            The launch is not running.

        """
        args = self.__args if self.__ignore_context else (context, *self.__args)
        loop = context.asyncio_loop
        if loop is None:
            raise RuntimeError('an OpaqueCoroutine can only be executed by a running launch')
        self.__task = loop.create_task(self.__coroutine(*args, **self.__kwargs))
        context.register_event_handler(OnShutdown(on_shutdown=self._cancel))

    def _cancel(self, event: object, context: LaunchContext) -> None:
        if self.__task is not None:
            self.__task.cancel()

    def get_asyncio_future(self) -> Optional[asyncio.Future[Any]]:
        """Return the task that runs the coroutine."""
        return self.__task
