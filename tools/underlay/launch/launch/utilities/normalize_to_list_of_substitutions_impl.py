# SPDX-License-Identifier: Apache-2.0
"""Normalise strings, paths and substitutions to a list of substitutions."""

from __future__ import annotations

import os
from typing import Any

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution


def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]:
    """
    Normalise strings, paths and substitutions to a list of substitutions.

    Parameters
    ----------
    subs
        A string, a path, a substitution or an iterable of them.

    Raises
    ------
    TypeError
        It is none of these.

    """
    if isinstance(subs, (str, os.PathLike, Substitution)):
        return [_normalize(subs)]
    return [_normalize(item) for item in subs]


def _normalize(item: Any) -> Substitution:
    from launch.substitutions.text_substitution import TextSubstitution

    if isinstance(item, Substitution):
        return item
    if isinstance(item, str):
        return TextSubstitution(text=item)
    if isinstance(item, os.PathLike):
        return TextSubstitution(text=os.fspath(item))
    raise TypeError(
        f"Failed to normalize given item of type '{type(item)}', when only 'str' or "
        "'launch.Substitution' were expected."
    )
