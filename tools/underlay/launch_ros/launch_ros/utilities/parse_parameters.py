# SPDX-License-Identifier: Apache-2.0
"""Parse parameters and remappings of XML and YAML launch files."""

from __future__ import annotations

from typing import Any, Optional, TYPE_CHECKING

from launch.frontend.attributes import children_named, parse_pairs
from launch.frontend.type_utils import get_data_type_from_identifier
from launch.substitution import Substitution, TextSubstitution
from launch.utilities.type_utils import is_substitution
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


def parse_parameters(entity: Entity, parser: Parser) -> dict[str, list[Any]]:
    """
    Parse the `param` children of an element into a keyword argument.

    Parameters
    ----------
    entity
        The element of a node.
    parser
        Parses substitutions in attributes.

    Returns
    -------
    dict
        The list under `parameters`; empty if there are no such children.

    """
    found = parse_nested_parameters(children_named(entity, 'param'), parser)
    return {'parameters': found} if found else {}


def parse_remappings(entity: Entity, parser: Parser) -> dict[str, list[Any]]:
    """
    Parse the `remap` children of an element into a keyword argument.

    Parameters
    ----------
    entity
        The element of a node.
    parser
        Parses substitutions in attributes.

    Returns
    -------
    dict
        The list of pairs under `remappings`; empty if there are no such children.

    """
    pairs = parse_pairs(entity, parser, 'remap', first='from', second='to')
    return {'remappings': pairs} if pairs else {}


def parse_nested_parameters(params: list[Entity], parser: Parser) -> list[Any]:
    """
    Parse `param` elements into dictionaries and parameter files.

    Parameters
    ----------
    params
        The elements.
    parser
        Parses substitutions in attributes.

    Returns
    -------
    list
        A dictionary for each element with a name, a ParameterFile for each with `from`.

    Raises
    ------
    ValueError
        An element has neither a value nor nested elements, or both, or an unknown attribute.

    """
    return [_parse_element(param, parser) for param in params]


def parse_value(
    entity: Entity,
    parser: Parser,
    type_identifier: Optional[str] = None,
    *,
    optional: bool = False,
) -> Any:
    """
    Parse the attribute `value` of an element.

    Parameters
    ----------
    entity
        The element of a parameter.
    parser
        Parses substitutions in attributes.
    type_identifier
        The requested type, such as `str` or `list_of_int`; None for YAML rules.
    optional
        Whether the attribute may be missing.

    Returns
    -------
    Any
        The value or its substitutions, as a ParameterValue if a type is requested; None if it
        is missing.

    Raises
    ------
    AttributeError
        The attribute is missing and not optional.
    ValueError
        The type does not exist.

    """
    data_type = None if type_identifier is None else get_data_type_from_identifier(type_identifier)
    value = entity.get_attr('value', data_type=data_type, optional=optional)
    if value is None:
        return None
    parsed = _parse_texts(parser.parse_if_substitutions(value))
    if type_identifier is not None:
        return ParameterValue(parsed, value_type=data_type)
    return parsed


def _parse_element(param: Entity, parser: Parser) -> Any:
    path = param.get_attr('from', optional=True)
    if path is None:
        result: Any = _parse_named(param, parser)
    else:
        allowed = param.get_attr('allow_substs', data_type=bool, optional=True, can_be_str=False)
        result = ParameterFile(parser.parse_substitution(path), allow_substs=bool(allowed))
    param.assert_entity_completely_parsed()
    return result


def _parse_named(param: Entity, parser: Parser) -> dict[Any, Any]:
    name = tuple(parser.parse_substitution(param.get_attr('name')))
    nested = children_named(param, 'param')
    identifier = param.get_attr('type', optional=True)
    value = parse_value(param, parser, identifier, optional=True)
    if (value is None) == (not nested):
        raise ValueError(
            f"the parameter '{param.get_attr('name')}' must have either a 'value' or nested "
            "elements 'param'" + (', but it has both' if nested else '')
        )
    return {name: _nested(nested, parser) if nested else value}


def _nested(params: list[Entity], parser: Parser) -> dict[Any, Any]:
    inner: dict[Any, Any] = {}
    for each in parse_nested_parameters(params, parser):
        if not isinstance(each, dict):
            raise ValueError("a 'param' with 'from' cannot be nested in another: put it beside it")
        inner.update(each)
    return inner


def _parse_texts(value: Any) -> Any:
    """Convert values that consist of plain text to strings; leave others as substitutions."""
    if not isinstance(value, list) or not value:
        return value
    if isinstance(value[0], Substitution):
        return _plain(value) if _is_plain(value) else value
    if isinstance(value[0], list):
        return [_plain(item) for item in value] if all(map(_is_plain, value)) else value
    return value


def _is_plain(parts: list[Substitution]) -> bool:
    return is_substitution(parts) and all(isinstance(part, TextSubstitution) for part in parts)


def _plain(parts: list[Any]) -> str:
    return ''.join(part.text for part in parts)
