# SPDX-License-Identifier: Apache-2.0
"""The substitutions: text that is known only when the launch runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_exports

if TYPE_CHECKING:
    from .anon_name import AnonName
    from .boolean_substitution import AllSubstitution
    from .boolean_substitution import AndSubstitution
    from .boolean_substitution import AnySubstitution
    from .boolean_substitution import NotSubstitution
    from .boolean_substitution import OrSubstitution
    from .command import Command
    from .environment_variable import EnvironmentVariable
    from .equals_substitution import EqualsSubstitution
    from .file_content import FileContent
    from .find_executable import FindExecutable
    from .if_else_substitution import IfElseSubstitution
    from .launch_configuration import LaunchConfiguration
    from .launch_log_dir import LaunchLogDir
    from .local_substitution import LocalSubstitution
    from .not_equals_substitution import NotEqualsSubstitution
    from .path_join_substitution import PathJoinSubstitution
    from .path_substitution import PathSubstitution
    from .python_expression import PythonExpression
    from .substitution_failure import SubstitutionFailure
    from .text_substitution import TextSubstitution
    from .this_launch_file import ThisLaunchFile
    from .this_launch_file_dir import ThisLaunchFileDir

__all__ = [
    'AllSubstitution',
    'AndSubstitution',
    'AnonName',
    'AnySubstitution',
    'Command',
    'EnvironmentVariable',
    'EqualsSubstitution',
    'FileContent',
    'FindExecutable',
    'IfElseSubstitution',
    'LaunchConfiguration',
    'LaunchLogDir',
    'LocalSubstitution',
    'NotEqualsSubstitution',
    'NotSubstitution',
    'OrSubstitution',
    'PathJoinSubstitution',
    'PathSubstitution',
    'PythonExpression',
    'SubstitutionFailure',
    'TextSubstitution',
    'ThisLaunchFile',
    'ThisLaunchFileDir',
]

_ELSEWHERE = {
    'AllSubstitution': 'boolean_substitution',
    'AndSubstitution': 'boolean_substitution',
    'AnySubstitution': 'boolean_substitution',
    'NotSubstitution': 'boolean_substitution',
    'OrSubstitution': 'boolean_substitution',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
