# SPDX-License-Identifier: Apache-2.0
"""Launch action for chains of lifecycle transitions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Union

from launch.action import Action
from launch.actions.emit_event import EmitEvent
from launch.actions.register_event_handler import RegisterEventHandler
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution


class LifecycleTransition(Action):
    """
    Takes each of some lifecycle nodes of this launch through a chain of transitions.

    Parameters
    ----------
    lifecycle_node_names
        The fully qualified names of the nodes; the leading slash is optional.
    transition_ids
        Constants of lifecycle_msgs.msg.Transition, or substitutions for them, in order.
    **kwargs
        As for `Action`: `condition`.

    Raises
    ------
    ValueError
        There are no names or no transitions, or a string is given instead of a list.

    """

    def __init__(
        self,
        *,
        lifecycle_node_names: Iterable[SomeSubstitutionsType],
        transition_ids: Iterable[Union[int, SomeSubstitutionsType]],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__names = [
            normalize_to_list_of_substitutions(name)
            for name in _some('lifecycle_node_names', lifecycle_node_names)
        ]
        self.__transition_ids = [
            normalize_typed_substitution(each, int)
            for each in _some('transition_ids', transition_ids)
        ]

    @property
    def lifecycle_node_names(self) -> list[list[Substitution]]:
        """Return the node names, as substitutions."""
        return self.__names

    @property
    def transition_ids(self) -> list[Any]:
        """Return the transition ids, or the substitutions that evaluate to them."""
        return self.__transition_ids

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """
        Request the first transition of each node; a TransitionChain requests the others.

        Parameters
        ----------
        context
            The launch context used to perform substitutions.

        Returns
        -------
        list of LaunchDescriptionEntity
            For each node, the action that registers its chain and the one that emits the first
            event.

        Raises
        ------
        ValueError
            A transition cannot be part of a chain.

        """
        from launch_ros.actions._transition_chain import TransitionChain

        transition_ids = [
            perform_typed_substitution(context, each, int) for each in self.__transition_ids
        ]
        entities: list[LaunchDescriptionEntity] = []
        for parts in self.__names:
            chain = TransitionChain(perform_substitutions(context, parts), transition_ids)
            entities += [RegisterEventHandler(chain), EmitEvent(event=chain.next_request())]
        return entities


def _some(name: str, values: Iterable[Any]) -> list[Any]:
    """Convert values to a list; reject strings and empty lists."""
    found = [] if isinstance(values, str) else list(values)
    if not found:
        raise ValueError(f'{name} of LifecycleTransition must be a list of at least one item')
    return found
