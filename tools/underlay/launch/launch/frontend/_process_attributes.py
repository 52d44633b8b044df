# SPDX-License-Identifier: Apache-2.0
"""Read the attributes of elements that describe processes."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.frontend._children import parse_pairs
from launch.frontend._command_words import command_words

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser

# Attributes with substitutions, and the constructor arguments that they become.
_TEXTS = {
    'cwd': 'cwd',
    'launch-prefix': 'prefix',
    'name': 'name',
    'output': 'output',
}
# Typed attributes that may have substitutions.
_LATER_TYPED = {
    'detached': bool,
    'respawn': bool,
    'sigkill_timeout': float,
    'sigterm_timeout': float,
}
# Typed attributes without substitutions.
_TYPED = {'emulate_tty': bool, 'respawn_delay': float, 'respawn_max_retries': int, 'shell': bool}


def parse_process(entity: Entity, parser: Parser, ignored: frozenset[str]) -> dict[str, Any]:
    """
    Read the attributes of an element that describes a process.

    Parameters
    ----------
    entity
        The element.
    parser
        The parser of the file, which parses substitutions.
    ignored
        The names of attributes that are left to the caller.

    Returns
    -------
    dict
        Keyword arguments of `ExecuteProcess`.

    Raises
    ------
    ValueError
        The attribute `on_exit` is not `shutdown`.

    """
    kwargs = parse_texts(
        entity, parser, {name: kw for name, kw in _TEXTS.items() if name not in ignored}
    )
    for name, data_type in {**_TYPED, **_LATER_TYPED}.items():
        if name not in ignored:
            later = name in _LATER_TYPED
            value = entity.get_attr(name, data_type=data_type, optional=True, can_be_str=later)
            if value is not None:
                kwargs[name] = parser.parse_if_substitutions(value)
    if 'cmd' not in ignored:
        kwargs['cmd'] = parse_command(entity.get_attr('cmd'), parser)
    if 'on_exit' not in ignored:
        kwargs.update(_parse_on_exit(entity))
    if 'env' not in ignored:
        pairs = parse_pairs(entity, parser, 'env')
        kwargs.update({'additional_env': dict(pairs)} if pairs else {})
    return kwargs


def parse_texts(entity: Entity, parser: Parser, names: dict[str, str]) -> dict[str, Any]:
    """
    Read optional string attributes of an element.

    Parameters
    ----------
    entity
        The element.
    parser
        The parser of the file, which parses substitutions.
    names
        The keyword of each attribute in the result.

    Returns
    -------
    dict
        The substitutions of each present attribute, by its keyword.

    """
    kwargs: dict[str, Any] = {}
    for name, keyword in names.items():
        text = entity.get_attr(name, optional=True)
        if text is not None:
            kwargs[keyword] = parser.parse_substitution(text)
    return kwargs


def parse_command(text: str, parser: Parser) -> list[Any]:
    """
    Split a command line of a launch file into words.

    Parameters
    ----------
    text
        The command line.
    parser
        The parser of the file, which parses substitutions.

    Returns
    -------
    list of list of Substitution
        The parts of each word.

    Raises
    ------
    ValueError
        A quote is never closed.

    """
    return list(command_words(parser.parse_substitution(text)))


def _parse_on_exit(entity: Entity) -> dict[str, Any]:
    reaction = entity.get_attr('on_exit', optional=True)
    if reaction is None:
        return {}
    if reaction != 'shutdown':
        raise ValueError(
            f"Attribute on_exit of Entity {entity.type_name} must be 'shutdown', the only "
            f"reaction that a launch file can name there, but it is '{reaction}'"
        )
    from launch.actions.shutdown_action import Shutdown

    return {'on_exit': [Shutdown()]}
