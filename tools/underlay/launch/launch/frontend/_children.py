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
    """Return the children with any of some tags in order; there may be none."""
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
    """Return two attributes of each child with any of some tags."""
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
