# SPDX-License-Identifier: Apache-2.0
"""The action that calls a function of the launch file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Optional, TYPE_CHECKING

from launch.action import Action
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
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
