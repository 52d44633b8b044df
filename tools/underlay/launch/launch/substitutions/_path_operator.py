# SPDX-License-Identifier: Apache-2.0
"""The operator that joins paths."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.substitutions.path_join_substitution import PathJoinSubstitution


class PathOperator(Substitution):
    """Base class of substitutions of paths that can be joined with `/`."""

    def __truediv__(self, other: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return this path joined with another."""
        from launch.substitutions.path_join_substitution import PathJoinSubstitution

        return PathJoinSubstitution([self, other])
