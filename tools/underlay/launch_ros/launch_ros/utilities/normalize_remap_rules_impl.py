# SPDX-License-Identifier: Apache-2.0
"""Normalize and evaluate remapping rules."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from launch.launch_context import LaunchContext
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions

SomeRemapRule = tuple[SomeSubstitutionsType, SomeSubstitutionsType]
RemapRule = tuple[list[Substitution], list[Substitution]]


def normalize_remap_rule(remap_rule: Any) -> RemapRule:
    """
    Convert both sides of a remapping to substitutions.

    Parameters
    ----------
    remap_rule
        A tuple of the original and the new name.

    Raises
    ------
    TypeError
        The argument is not such a tuple.

    """
    if not isinstance(remap_rule, tuple) or len(remap_rule) != 2:
        raise TypeError(
            "a remapping must be a tuple such as ('from', 'to'), but got "
            f"{remap_rule!r} of type '{type(remap_rule).__name__}'"
        )
    return (
        normalize_to_list_of_substitutions(remap_rule[0]),
        normalize_to_list_of_substitutions(remap_rule[1]),
    )


def normalize_remap_rules(remap_rules: Iterable[Any]) -> list[RemapRule]:
    """
    Convert both sides of each remapping to substitutions.

    Parameters
    ----------
    remap_rules
        As for `normalize_remap_rule`, whose exceptions propagate.

    """
    return [normalize_remap_rule(rule) for rule in remap_rules]


def evaluate_remap_rule(context: LaunchContext, rule: RemapRule) -> tuple[str, str]:
    """
    Evaluate both sides of a remapping to strings.

    Parameters
    ----------
    context
        The launch context used to perform substitutions.
    rule
        The result of `normalize_remap_rule`.

    """
    return perform_substitutions(context, rule[0]), perform_substitutions(context, rule[1])
