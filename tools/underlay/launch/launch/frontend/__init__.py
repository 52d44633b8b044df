# SPDX-License-Identifier: Apache-2.0
"""Common code of the parsers of launch files in formats other than Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch.frontend import expose, parse_substitution, type_utils
    from launch.frontend.entity import Entity
    from launch.frontend.expose import expose_action, expose_substitution
    from launch.frontend.parse_substitution import InvalidSubstitutionError
    from launch.frontend.parser import Parser
    from launch.invalid_launch_file_error import InvalidFrontendLaunchFileError

__all__ = [
    'Entity',
    'InvalidFrontendLaunchFileError',
    'InvalidSubstitutionError',
    'Parser',
    'expose',
    'expose_action',
    'expose_substitution',
    'parse_substitution',
    'type_utils',
]

_ELSEWHERE = {
    'InvalidFrontendLaunchFileError': 'parser',
    'InvalidSubstitutionError': 'parse_substitution',
    'expose': '',
    'expose_action': 'expose',
    'expose_substitution': 'expose',
    'parse_substitution': '',
    'type_utils': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
