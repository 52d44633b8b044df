# SPDX-License-Identifier: Apache-2.0
"""Arguments of actions: of the right type, or an error that names the keyword."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import os
from typing import Any, NoReturn, Optional

from launch.substitution import Substitution
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.type_utils import normalize_typed_substitution


def text_like(keyword: str, value: Any) -> list[Substitution]:
    """Return a text, a substitution or a list of them as a list of substitutions."""
    try:
        return normalize_to_list_of_substitutions(value)
    except TypeError as error:
        _refuse(keyword, 'a text, a substitution or a list of them', value, error)


def optional_text_like(keyword: str, value: Any) -> Optional[list[Substitution]]:
    """Return the same, or None for None."""
    return None if value is None else text_like(keyword, value)


def list_like(keyword: str, value: Any, items: str) -> list[Any]:
    """Return an iterable as a list; a text, which would fall apart into letters, is refused."""
    is_single = isinstance(value, (str, bytes, os.PathLike, Substitution, Mapping))
    if is_single or not isinstance(value, Iterable):
        _refuse(keyword, f'a list of {items}', value)
    return list(value)


def mapping_like(keyword: str, value: Any) -> Mapping[Any, Any]:
    """Return a dictionary, or pairs as one."""
    if isinstance(value, Mapping):
        return value
    try:
        return dict(value)
    except (TypeError, ValueError):
        _refuse(keyword, 'a dictionary', value)


def of_type(keyword: str, value: Any, types: tuple[type, ...], expected: str) -> None:
    """Raise an error unless a value has one of some types."""
    if not isinstance(value, types):
        _refuse(keyword, expected, value)


def typed(keyword: str, value: Any, kind: Any, expected: str) -> Any:
    """Return a value of a type as it is, and what stands for one as substitutions."""
    try:
        return normalize_typed_substitution(value, kind)
    except TypeError:
        _refuse(keyword, expected, value)


def unknown_keyword(owner: type, keyword: str) -> TypeError:
    """Return the error about a keyword that a class does not know, with the closest one."""
    from launch._did_you_mean import did_you_mean

    known = {
        name
        for each in owner.__mro__
        for name in getattr(each.__init__, '__kwdefaults__', None) or ()  # type: ignore[misc]
    }
    hint = did_you_mean(keyword, known)
    text = f"{owner.__name__}() got an unexpected keyword argument '{keyword}'"
    return TypeError(f'{text}. {hint}' if hint else text)


def _refuse(
    keyword: str,
    expected: str,
    value: Any,
    error: Optional[TypeError] = None,
) -> NoReturn:
    """Raise the error; what made it unfit is added."""
    found = f"{value!r} of type '{type(value).__name__}'"
    inside = f' ({error})' if error is not None else ''
    raise TypeError(f"the argument '{keyword}' must be {expected}, but it is {found}{inside}")
