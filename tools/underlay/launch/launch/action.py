# SPDX-License-Identifier: Apache-2.0
"""The base class of all actions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.failures import calling_line, CallSite
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.conditions import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class Action(LaunchDescriptionEntity):
    """
    Base class of actions: something to do, at once or on an event, perhaps under a condition.

    Parameters
    ----------
    condition
        The condition under which the action is executed; None for always.
    **unknown
        Unknown keywords, which raise an error.

    Attributes
    ----------
    call_site
        The line of the launch file that created the action, None if it is not known.

    Raises
    ------
    TypeError
        The condition cannot be evaluated, or a keyword is unknown; the closest one is suggested.

    """

    call_site: Optional[CallSite] = None

    def __init__(self, *, condition: Optional[Condition] = None, **unknown: Any) -> None:
        if unknown:
            raise _unknown_keyword(type(self), next(iter(unknown)))
        if condition is not None and not hasattr(condition, 'evaluate'):
            raise TypeError(
                "the argument 'condition' must be a condition such as IfCondition(...), but it is "
                f"{condition!r} of type '{type(condition).__name__}'"
            )
        self.__condition = condition
        self.call_site = calling_line()

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse the constructor arguments of the action from an element of a launch file.

        Subclasses extend the result.

        Parameters
        ----------
        entity
            The element; here its attributes `if` and `unless` are read.
        parser
            The parser of the file, which parses substitutions.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        Raises
        ------
        RuntimeError
            The element has both `if` and `unless`.

        """
        from launch.conditions import IfCondition, UnlessCondition

        wanted = entity.get_attr('if', optional=True)
        unwanted = entity.get_attr('unless', optional=True)
        if wanted is not None and unwanted is not None:
            raise RuntimeError("if and unless conditions can't be used simultaneously")
        if wanted is not None:
            return cls, {'condition': IfCondition(parser.parse_substitution(wanted))}
        if unwanted is not None:
            return cls, {'condition': UnlessCondition(parser.parse_substitution(unwanted))}
        return cls, {}

    @property
    def condition(self) -> Optional[Condition]:
        """Return the condition, or None if the action is always executed."""
        return self.__condition

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the sub-entities of the action; subclasses override this."""
        return []

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'Action({self!r})'

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the sub-entities that are visited unconditionally."""
        return self.get_sub_entities() if self.__condition is None else []

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the entities that are visited if the condition is fulfilled."""
        if self.__condition is None:
            return []
        return [(f'Conditionally included by {self.describe()}', self.get_sub_entities())]

    def visit(self, context: LaunchContext) -> Optional[Iterable[LaunchDescriptionEntity]]:
        """
        Execute the action if its condition allows it.

        Parameters
        ----------
        context
            The launch context.

        Returns
        -------
        iterable of LaunchDescriptionEntity or None
            The result of `execute`; None if the condition is not fulfilled.

        """
        if self.__condition is not None and not self._is_wanted(self.__condition, context):
            return None
        try:
            return self.execute(context)
        finally:
            self._announce_completion(context)

    def _is_wanted(self, condition: Condition, context: LaunchContext) -> bool:
        """Evaluate the condition, and notify the observer."""
        value = bool(condition.evaluate(context))
        if context.run.observer is not None:
            context.run.observer.decided(self, value)
        return value

    def outline(self) -> dict[str, Any]:
        """Return the facts that are known about the action before it is executed."""
        return {}

    def outline_of_waiting(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the entities that the action will leave waiting, with the event in words."""
        return []

    def _announce_completion(self, context: LaunchContext) -> None:
        """Emit ExecutionComplete at the end of the execution if a handler matches it."""
        from launch.events import ExecutionComplete

        event = ExecutionComplete(action=self)
        if not context.would_handle_event(event):
            return
        future = self.get_asyncio_future()
        if future is None:
            context.emit_event_sync(event)
        else:
            future.add_done_callback(lambda _: context.emit_event_sync(event))

    def execute(self, context: LaunchContext) -> Optional[Iterable[LaunchDescriptionEntity]]:
        """
        Execute the action; subclasses override this.

        Parameters
        ----------
        context
            The launch context, in which substitutions are performed.

        Returns
        -------
        iterable of LaunchDescriptionEntity or None
            The entities that are visited next.

        Raises
        ------
        NotImplementedError
            The class does not override it.

        """
        raise NotImplementedError(
            f"the action class '{type(self).__name__}' does not define execute(context)"
        )


def _unknown_keyword(owner: type, keyword: str) -> TypeError:
    """Create the error for an unknown keyword argument, with a suggestion."""
    from ros_environment.suggestions import did_you_mean

    known = {
        name
        for each in owner.__mro__
        for name in getattr(each.__init__, '__kwdefaults__', None) or ()  # type: ignore[misc]
    }
    hint = did_you_mean(keyword, known)
    text = f"{owner.__name__}() got an unexpected keyword argument '{keyword}'"
    return TypeError(f'{text}. {hint}' if hint else text)
