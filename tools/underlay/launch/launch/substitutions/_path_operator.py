# SPDX-License-Identifier: Apache-2.0
"""The operator that joins paths."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..some_substitutions_type import SomeSubstitutionsType
from ..substitution import Substitution

if TYPE_CHECKING:
    from .path_join_substitution import PathJoinSubstitution


class PathOperator(Substitution):
    """Lets a substitution that stands for a path be joined with `/`."""

    def __truediv__(self, other: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return this path joined with another."""
        from .path_join_substitution import PathJoinSubstitution
        return PathJoinSubstitution([self, other])
