# SPDX-License-Identifier: Apache-2.0
"""Make actions and substitutions available to launch files that are not in Python."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TYPE_CHECKING, TypeVar

from launch.frontend import _complaints
from launch.frontend._known_names import known_actions, known_substitutions, load

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.substitution import Substitution

ExposedT = TypeVar('ExposedT')
ParseMethod = Callable[..., Any]

action_parse_methods: dict[str, ParseMethod] = {}
substitution_parse_methods: dict[str, ParseMethod] = {}


def expose_action(name: str) -> Callable[[ExposedT], ExposedT]:
    """
    Create a decorator that makes an action available to launch files under a tag.

    Parameters
    ----------
    name
        The tag.

    Returns
    -------
    callable
        Decorator of a class that has `parse`, or of a parsing function. It raises a
        RuntimeError if the tag is taken, or if there is no method to parse with.

    """
    return _expose(name, action_parse_methods, known_actions)


def expose_substitution(name: str) -> Callable[[ExposedT], ExposedT]:
    """
    Create a decorator that makes a substitution available to launch files under a name.

    Parameters
    ----------
    name
        The name.

    Returns
    -------
    callable
        As for `expose_action`.

    """
    return _expose(name, substitution_parse_methods, known_substitutions)


def instantiate_action(entity: Entity, parser: Parser) -> Action:
    """
    Create the action that an element describes.

    Parameters
    ----------
    entity
        The element, all attributes and children of which must be read.
    parser
        The parser of the file.

    Raises
    ------
    RuntimeError
        No action has the tag of the element.
    ValueError
        The element has attributes or children that it cannot have.

    """
    method = _find(entity.type_name, action_parse_methods, known_actions())
    if method is None:
        names = [*known_actions(), *action_parse_methods]
        raise RuntimeError(_complaints.unknown_tag(entity.type_name, names))
    action_class, kwargs = method(entity, parser)
    entity.assert_entity_completely_parsed()
    action: Action = action_class(**kwargs)
    return action


def instantiate_substitution(name: str, arguments: Iterable[Any]) -> Substitution:
    """
    Create a substitution by its name in launch files.

    Parameters
    ----------
    name
        The name.
    arguments : Iterable[Any]
        Its arguments, each as a list of substitutions.

    Raises
    ------
    LookupError
        No substitution has the name.

    """
    method = _find(name, substitution_parse_methods, known_substitutions())
    if method is None:
        names = [*known_substitutions(), *substitution_parse_methods]
        raise LookupError(_complaints.unknown_substitution(name, names))
    substitution_class, kwargs = method(list(arguments))
    substitution: Substitution = substitution_class(**kwargs)
    return substitution


def _expose(
    name: str,
    exposed: dict[str, ParseMethod],
    known: Callable[[], dict[str, str]],
) -> Callable[[ExposedT], ExposedT]:
    def register(thing: ExposedT) -> ExposedT:
        if name in known() or (name in exposed and exposed[name] != _parse_method(thing)):
            raise RuntimeError(
                f"two parsing methods are exposed under the name '{name}': {thing!r} needs another"
            )
        exposed[name] = _parse_method(thing)
        return thing

    return register


def _parse_method(thing: Any) -> ParseMethod:
    """Return the function itself, or the method `parse` of a class."""
    method = thing.parse if isinstance(thing, type) and hasattr(thing, 'parse') else thing
    if (isinstance(thing, type) and method is thing) or not callable(method):
        raise RuntimeError(f"the exposed {thing!r} is no function, and has no method 'parse'")
    parse_method: ParseMethod = method
    return parse_method


def _find(
    name: str,
    exposed: dict[str, ParseMethod],
    known: dict[str, str],
) -> ParseMethod | None:
    """Find the parse method of a name: built-in, registered, or of an extension."""
    if name in known:
        return _parse_method(load(known[name]))
    if name not in exposed:
        from launch.frontend._extensions import load_extensions

        load_extensions()
    return exposed.get(name)
