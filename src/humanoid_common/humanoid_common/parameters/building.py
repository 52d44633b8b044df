# SPDX-License-Identifier: Apache-2.0
"""Build a checked snapshot of all parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

from humanoid_common.parameters.specs import specs_of
from humanoid_common.parameters.values import checked_value

T = TypeVar('T')


def build(kind: type[T], values: Mapping[str, Any]) -> T:
    """
    Build a parameter dataclass from values; those that are missing take their defaults.

    Each value is checked by the rules of its field; then the dataclass itself checks, in its
    `__post_init__`, what must hold for all of them together.

    Parameters
    ----------
    kind
        The dataclass, whose fields are declared with `parameter`.
    values
        Values by the names of its fields.

    Raises
    ------
    ParameterError
        A value breaks the rules of its parameter, or the values do not fit together.

    """
    specs = specs_of(kind)
    checked = {name: checked_value(specs[name], value) for name, value in values.items()}
    return kind(**checked)
