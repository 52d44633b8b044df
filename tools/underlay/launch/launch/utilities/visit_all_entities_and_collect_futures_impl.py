# SPDX-License-Identifier: Apache-2.0
"""Visit a tree of entities."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext

    EntityFuturePairs = list[tuple[LaunchDescriptionEntity, asyncio.Future[Any]]]


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
    observer = context._observer
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
        from launch._failure_place import note_place

        note_place(error, entity, context)
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
