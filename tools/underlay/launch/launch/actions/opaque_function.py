# SPDX-License-Identifier: Apache-2.0
"""The actions that call a function, or run a coroutine, of the launch file."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Iterable, Mapping
from typing import Any, Optional, TYPE_CHECKING

from launch.action import Action
from launch.event_handlers.on_shutdown import OnShutdown
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext


class OpaqueFunction(Action):
    """
    Action that calls a function with the context; the entities it returns are visited next.

    Parameters
    ----------
    function
        The function, which is called with the context and `args`.
    args, kwargs
        Further positional and keyword arguments of the function.
    **left_over_kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        `function` is not callable.

    """

    runs_code_of_the_user = True

    def __init__(
        self,
        *,
        function: Callable[..., Optional[Iterable[LaunchDescriptionEntity]]],
        args: Optional[Iterable[Any]] = None,
        kwargs: Optional[Mapping[str, Any]] = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(function):
            raise TypeError(
                f"OpaqueFunction expected a callable as its function, but got '{function!r}'"
            )
        self.__function = function
        self.__args = tuple(args or ())
        self.__kwargs = dict(kwargs or {})

    def outline(self) -> dict[str, Any]:
        """Return the name of the function."""
        return {'function': getattr(self.__function, '__name__', repr(self.__function))}

    def execute(self, context: LaunchContext) -> Optional[Iterable[LaunchDescriptionEntity]]:
        """
        Call the function.

        Parameters
        ----------
        context
            The launch context, which is the first argument.

        Returns
        -------
        iterable of LaunchDescriptionEntity or None
            The entities that the function returns, which are visited next.

        Raises
        ------
        TypeError
            The function returns neither an iterable nor None.

        """
        if context.run.observer is not None:
            context.run.observer.note(**self.outline())
        result = self.__function(context, *self.__args, **self.__kwargs)
        if result is not None and not isinstance(result, Iterable):
            raise TypeError(
                f"'{type(result).__name__}' object is not iterable: the function "
                f"'{self.outline()['function']}' of an "
                'OpaqueFunction must return a list of actions or None'
            )
        return result


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
