# SPDX-License-Identifier: Apache-2.0
"""Type of a string, or of substitutions that are performed when the launch runs."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Union

from launch.substitution import Substitution

SomeSubstitutionsType = Union[
    str,
    'os.PathLike[str]',
    Substitution,
    Iterable[Union[str, 'os.PathLike[str]', Substitution]],
]

SomeSubstitutionsType_types_tuple = (str, os.PathLike, Substitution, Iterable)
