# SPDX-License-Identifier: Apache-2.0
"""Check in advance, without side effects, for errors that a later event would cause."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Any, Optional, TYPE_CHECKING

from launch._before_start import explain_missing_program, is_there, ProgramNotFoundError
from launch.failures import note_place
from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity

_NOT_SEARCHED = ('launch._supervision.supervisor', 'launch.launch_context')


def check_what_waits(context: LaunchContext) -> None:
    """
    Check the entities that wait for events, without visiting them.

    Conditional entities are skipped.

    Parameters
    ----------
    context
        The context of the launch, whose event handlers are searched.

    Raises
    ------
    Exception
        The first error that is certain to occur, annotated with its origin.

    """
    seen: set[int] = set()
    for handler in tuple(context.run.event_handlers):
        context.run.include_stack = handler.include_stack
        _check_all(handler.describe()[1], context, seen)


def waiting_entities(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    """
    Collect all entities that wait for an event, including nested ones.

    Parameters
    ----------
    context
        The context of the launch, whose event handlers are searched.

    """
    found: list[LaunchDescriptionEntity] = []
    for handler in tuple(context.run.event_handlers):
        for entity in handler.describe()[1]:
            _collect(entity, found)
    return found


def constant_text(parts: Any, context: LaunchContext) -> Optional[str]:
    """
    Perform substitutions in advance if they depend only on what is installed.

    Parameters
    ----------
    parts
        A string, a path, a substitution or an iterable of them.
    context
        The context in which they are performed.

    Returns
    -------
    str or None
        The text, or None if it may differ later.

    """
    from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

    substitutions = normalize_to_list_of_substitutions(parts)
    if not all(each.is_constant for each in substitutions_in(substitutions)):
        return None
    return perform_substitutions(context, substitutions)


def require_later_program(parts: Any, env: Any, context: LaunchContext) -> None:
    """
    Check the program of a process that waits for an event, as far as it is known.

    A missing path only causes a warning, as it may be created before the start.

    Parameters
    ----------
    parts
        The substitutions of the program.
    env
        The complete environment of the process; nothing is checked unless it is None.
    context
        The context in which the substitutions are performed.

    Raises
    ------
    ProgramNotFoundError
        A program given by name is not on the PATH.

    """
    program = constant_text(parts, context)
    if program is None or env is not None or is_there(program, None, None):
        return
    text = explain_missing_program(program)
    if not os.path.dirname(program):
        raise ProgramNotFoundError(text)
    from launch.logging import get_logger

    get_logger('launch').warning('%s (it waits for an event and may be created by then)', text)


def may_look_up(name: str, context: LaunchContext) -> bool:
    """
    Whether an entity that waits for an event may look up a launch configuration.

    User code cannot be searched, so it is assumed to do so.

    Parameters
    ----------
    name
        The name of the configuration.
    context
        The context of the launch, whose event handlers are searched.

    """
    from launch.substitutions.context_values import LaunchConfiguration
    from launch.utilities import perform_substitutions

    waiting = waiting_entities(context)
    if any(entity.runs_code_of_the_user for entity in waiting):
        return True
    found = [each for each in substitutions_in(waiting) if isinstance(each, LaunchConfiguration)]
    return any(
        not all(part.is_constant for part in substitutions_in(each.variable_name))
        or perform_substitutions(context, each.variable_name) == name
        for each in found
    )


def substitutions_in(value: Any) -> list[Substitution]:
    """
    Collect all substitutions in a value, at any depth.

    Parameters
    ----------
    value
        A container, an entity, a substitution, or anything else.

    Returns
    -------
    list of Substitution
        Each substitution once, outer ones before nested ones.

    """
    found: list[Substitution] = []
    _search(value, found, set())
    return found


def _check_all(
    entities: Iterable[LaunchDescriptionEntity],
    context: LaunchContext,
    seen: set[int],
) -> None:
    for entity in entities:
        if id(entity) in seen or getattr(entity, 'condition', None) is not None:
            continue
        seen.add(id(entity))
        try:
            entity.check_in_advance(context)
            _check_all(_inside(entity), context, seen)
        except Exception as error:
            note_place(error, entity, context.run.include_stack)
            raise


def _inside(entity: LaunchDescriptionEntity) -> list[LaunchDescriptionEntity]:
    """Return the sub-entities of an entity without reading any file."""
    if getattr(entity, 'includes_file', False):
        return []
    later = entity.describe_conditional_sub_entities()
    return [*entity.describe_sub_entities(), *(each for _, group in later for each in group)]


def _collect(entity: LaunchDescriptionEntity, found: list[LaunchDescriptionEntity]) -> None:
    if entity not in found:
        found.append(entity)
        for each in _inside(entity):
            _collect(each, found)


def _search(value: Any, found: list[Substitution], seen: set[int]) -> None:
    if id(value) in seen or isinstance(value, (str, bytes, int, float)):
        return
    seen.add(id(value))
    if isinstance(value, Substitution):
        found.append(value)
    for each in _parts(value):
        _search(each, found, seen)


def _parts(value: Any) -> list[Any]:
    """Return the direct members of a value, if it is a container or an object of launch."""
    if isinstance(value, (list, tuple, set, frozenset)):
        return list(value)
    if isinstance(value, dict):
        return [*value.keys(), *value.values()]
    module = type(value).__module__
    belongs = hasattr(value, 'visit') or hasattr(value, 'perform') or module.startswith('launch')
    if not belongs or module in _NOT_SEARCHED:
        return []
    return list(getattr(value, '__dict__', {}).values())
