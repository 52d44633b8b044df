# SPDX-License-Identifier: Apache-2.0
"""Helpers for actions, conditions and substitutions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from launch.utilities import type_utils
    from launch.utilities.class_tools_impl import is_a, is_a_subclass
    from launch.utilities.ensure_argument_type_impl import ensure_argument_type
    from launch.utilities.normalize_to_list_of_entities_impl import normalize_to_list_of_entities
    from launch.utilities.normalize_to_list_of_substitutions_impl import (
        normalize_to_list_of_substitutions,
    )
    from launch.utilities.perform_substitutions_impl import perform_substitutions
    from launch.utilities.visit_all_entities_and_collect_futures_impl import (
        visit_all_entities_and_collect_futures,
    )

__all__ = [
    'ensure_argument_type',
    'is_a',
    'is_a_subclass',
    'normalize_to_list_of_entities',
    'normalize_to_list_of_substitutions',
    'perform_substitutions',
    'type_utils',
    'visit_all_entities_and_collect_futures',
]

_ELSEWHERE = {
    'ensure_argument_type': 'ensure_argument_type_impl',
    'is_a': 'class_tools_impl',
    'is_a_subclass': 'class_tools_impl',
    'normalize_to_list_of_entities': 'normalize_to_list_of_entities_impl',
    'normalize_to_list_of_substitutions': 'normalize_to_list_of_substitutions_impl',
    'perform_substitutions': 'perform_substitutions_impl',
    'visit_all_entities_and_collect_futures': 'visit_all_entities_and_collect_futures_impl',
    'type_utils': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
