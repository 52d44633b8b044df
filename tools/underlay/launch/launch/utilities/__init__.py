# SPDX-License-Identifier: Apache-2.0
"""
Helpers for actions, conditions and substitutions.

They normalise what an argument may be, perform substitutions, and visit entities.
"""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_entities_type import SomeEntitiesType
from launch.substitution import SomeSubstitutionsType, Substitution
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext
    from launch.utilities import type_utils

    EntityFuturePairs = list[tuple[LaunchDescriptionEntity, asyncio.Future[Any]]]

__all__ = [
    'ensure_argument_type',
    'is_a',
    'is_a_subclass',
    'normalize_to_list_of_entities',
    'normalize_to_list_of_substitutions',
    'perform_substitutions',
    'type_utils',
    'visit_all_entities_and_collect_futures',
]


def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]:
    """
    Normalise strings, paths and substitutions to a list of substitutions.

    Parameters
    ----------
    subs
        A string, a path, a substitution or an iterable of them.

    Raises
    ------
    TypeError
        It is none of these.

    """
    if isinstance(subs, (str, os.PathLike, Substitution)):
        return [_normalize(subs)]
    return [_normalize(item) for item in subs]


def _normalize(item: Any) -> Substitution:
    from launch.substitution import TextSubstitution

    if isinstance(item, Substitution):
        return item
    if isinstance(item, str):
        return TextSubstitution(text=item)
    if isinstance(item, os.PathLike):
        return TextSubstitution(text=os.fspath(item))
    raise TypeError(
        f"Failed to normalize given item of type '{type(item)}', when only 'str' or "
        "'launch.Substitution' were expected."
    )


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """
    Perform substitutions and concatenate the results.

    Parameters
    ----------
    context
        The launch context.
    subs
        The substitutions, in order.

    """
    return ''.join([context.perform_substitution(sub) for sub in subs])


def normalize_to_list_of_entities(
    entities: Optional[SomeEntitiesType],
) -> list[LaunchDescriptionEntity]:
    """
    Normalise entities to a flat list without None.

    Parameters
    ----------
    entities
        An entity, an iterable of entities that may be nested, or None.

    Raises
    ------
    RuntimeError
        The argument contains something else.

    """
    flat: list[LaunchDescriptionEntity] = []
    _flatten(entities, flat)
    return flat


def _flatten(item: Any, into: list[LaunchDescriptionEntity]) -> None:
    if item is None:
        return
    if isinstance(item, LaunchDescriptionEntity):
        into.append(item)
    elif isinstance(item, Iterable) and not isinstance(item, str):
        for each in item:
            _flatten(each, into)
    else:
        raise RuntimeError(
            'expected a LaunchDescriptionEntity, a list of them or None as the reaction to an '
            f"event, but got '{item!r}' of type '{type(item).__name__}'"
        )


def visit_all_entities_and_collect_futures(
    entity: LaunchDescriptionEntity,
    context: LaunchContext,
) -> EntityFuturePairs:
    """
    Visit an entity and its sub-entities depth-first; collect their futures.

    Parameters
    ----------
    entity
        The entity.
    context
        The launch context.

    Returns
    -------
    list of tuple
        Each entity that has a future, with the future.

    """
    futures: EntityFuturePairs = []
    visit_into(entity, context, futures)
    return futures


def visit_into(
    entity: LaunchDescriptionEntity,
    context: LaunchContext,
    futures: EntityFuturePairs,
) -> None:
    """
    Visit an entity and its sub-entities depth-first; add their futures to a list.

    Parameters
    ----------
    entity
        The entity.
    context
        The launch context.
    futures
        The list; futures that were collected before a failure stay in it.

    Raises
    ------
    AttributeError
        An entity returns an object that is neither an action nor a launch description.

    """
    observer = context.run.observer
    if observer is not None:
        observer.enter(entity)
    try:
        children = entity.visit(context)
        future = entity.get_asyncio_future()
        if future is not None:
            futures.append((entity, future))
        if children is not None:
            for child in children:
                visit_into(_checked(child, entity), context, futures)
    except Exception as error:
        from launch.failures import note_place

        note_place(error, entity, context.run.include_stack)
        raise
    if observer is not None:
        observer.leave(entity)


def _checked(child: Any, parent: LaunchDescriptionEntity) -> Any:
    """
    Return the child if it can be visited; otherwise, raise an error that names its parent.

    An action that launch itself has created inherits the call site of its parent.
    """
    if hasattr(child, 'visit'):
        if getattr(child, 'call_site', parent) is None:
            child.call_site = getattr(parent, 'call_site', None)
        return child
    raise AttributeError(
        f"'{type(child).__name__}' object has no attribute 'visit': the entities of "
        f'{type(parent).__name__} must be actions or launch descriptions, but one is {child!r}'
    )


def ensure_argument_type(
    argument: Any,
    types: Union[type, Iterable[type]],
    argument_name: str,
    caller: Optional[str] = None,
) -> None:
    """
    Check the type of an argument.

    Parameters
    ----------
    argument
        The value of the argument.
    types
        The class, or the classes, of which it must be an instance.
    argument_name
        Its name, for the error.
    caller
        The owner of the argument, for the error.

    Raises
    ------
    TypeError
        The argument has another type.

    """
    allowed = (types,) if isinstance(types, type) else tuple(types)
    if isinstance(argument, allowed):
        return
    names = ' or '.join(f"'{each.__name__}'" for each in allowed)
    where = f" of '{caller}'" if caller else ''
    raise TypeError(
        f"Expected '{argument_name}'{where} to be {names}, "
        f"but got '{argument!r}' of type '{type(argument)}'"
    )


def is_a(entity: Any, of_type: type) -> bool:
    """
    Whether an object is an instance of a class.

    Parameters
    ----------
    entity
        The object.
    of_type
        The class.

    """
    return isinstance(entity, of_type)


def is_a_subclass(entity: Any, of_type: type) -> bool:
    """
    Whether an object is a subclass of a class, or an instance of it.

    Parameters
    ----------
    entity
        The object.
    of_type
        The other class.

    """
    if isinstance(entity, type):
        return issubclass(entity, of_type)
    return isinstance(entity, of_type)


# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'class_tools_impl',
    'ensure_argument_type_impl',
    'normalize_to_list_of_entities_impl',
    'normalize_to_list_of_substitutions_impl',
    'perform_substitutions_impl',
    'visit_all_entities_and_collect_futures_impl',
)

_ELSEWHERE = {
    'type_utils': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
