# SPDX-License-Identifier: Apache-2.0
"""Make actions and substitutions available to launch files that are not in Python."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TYPE_CHECKING, TypeVar

from launch.frontend._known_names import (
    known_actions,
    known_substitutions,
    load,
    load_extensions,
)
from ros_environment.suggestions import did_you_mean

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.substitution import Substitution

ExposedT = TypeVar('ExposedT')
ParseMethod = Callable[..., Any]

# Names of ROS 1, and of other places, with what ROS 2 has instead.
_TAGS = {
    'rosparam': 'write <param from="FILE"/> in the node',
    'test': 'tests are Python files, see launch_testing',
    'machine': 'all nodes run on this machine',
    'env': 'write <set_env name="..." value="..."/>',
    'param': 'write <param> in a node, or <set_parameter name="..." value="..."/> for all',
    'remap': 'write <remap> in a node, or <set_remap from="..." to="..."/> for all',
}
_SUBSTITUTIONS = {
    'optenv': '$(env NAME DEFAULT)',
    'find': '$(find-pkg-share PACKAGE)',
    'arg': '$(var NAME)',
}

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
        raise RuntimeError(_unknown_tag(entity.type_name, names))
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
        raise LookupError(_unknown_substitution(name, names))
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
        load_extensions()
    return exposed.get(name)


def _unknown_tag(name: str, known: Iterable[str]) -> str:
    """Format the error about a tag that does not exist, with a suggestion."""
    old = f"'{name}' is none of the tags of ROS 2: {_TAGS[name]}." if name in _TAGS else ''
    text = f'Unrecognized entity of the type: {name}'
    return '\n'.join(filter(None, [text, old or did_you_mean(name, known)]))


def _unknown_substitution(name: str, known: Iterable[str]) -> str:
    """Format the error about a substitution that does not exist, with a suggestion."""
    new = _SUBSTITUTIONS.get(name)
    old = f"ROS 2 writes '{new}'." if new else ''
    text = f'Unknown substitution: {name}'
    return '\n'.join(filter(None, [text, old or did_you_mean(name, known)]))
