# SPDX-License-Identifier: Apache-2.0
"""Read the children of elements."""

from __future__ import annotations

from typing import List, TYPE_CHECKING  # noqa: UP035

from launch.frontend.entity import Entity
from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.frontend.parser import Parser

Text = tuple[Substitution, ...]


def children_named(entity: Entity, *type_names: str) -> list[Entity]:
    """
    Get the children of an element that have any of the given tags.

    Parameters
    ----------
    entity
        The element.
    *type_names
        The tags.

    Returns
    -------
    list of Entity
        The children in the order of the file; there may be none.

    """
    found: list[Entity] = []
    for name in type_names:
        found += entity.get_attr(name, data_type=List[Entity], optional=True) or []  # noqa: UP006
    return sorted(found, key=lambda child: child.order)


def parse_pairs(
    entity: Entity,
    parser: Parser,
    *type_names: str,
    first: str = 'name',
    second: str = 'value',
) -> list[tuple[Text, Text]]:
    """
    Read two attributes of each child of an element that has any of the given tags.

    Parameters
    ----------
    entity
        The element.
    parser
        The parser of the file, which parses substitutions.
    *type_names
        The tags of the children.
    first, second
        The names of the two attributes.

    Returns
    -------
    list of tuple
        The substitutions of both attributes of each child.

    Raises
    ------
    AttributeError
        A child lacks one of the attributes.
    ValueError
        A child has other attributes or children.

    """
    pairs = []
    for child in children_named(entity, *type_names):
        pairs.append(
            (
                tuple(parser.parse_substitution(child.get_attr(first))),
                tuple(parser.parse_substitution(child.get_attr(second))),
            )
        )
        child.assert_entity_completely_parsed()
    return pairs
