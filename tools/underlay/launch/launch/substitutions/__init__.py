# SPDX-License-Identifier: Apache-2.0
"""The substitutions: text that is known only when the launch runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_exports

if TYPE_CHECKING:
    from .anon_name import AnonName as AnonName
    from .boolean_substitution import AllSubstitution as AllSubstitution
    from .boolean_substitution import AndSubstitution as AndSubstitution
    from .boolean_substitution import AnySubstitution as AnySubstitution
    from .boolean_substitution import NotSubstitution as NotSubstitution
    from .boolean_substitution import OrSubstitution as OrSubstitution
    from .command import Command as Command
    from .environment_variable import EnvironmentVariable as EnvironmentVariable
    from .equals_substitution import EqualsSubstitution as EqualsSubstitution
    from .file_content import FileContent as FileContent
    from .find_executable import FindExecutable as FindExecutable
    from .if_else_substitution import IfElseSubstitution as IfElseSubstitution
    from .launch_configuration import LaunchConfiguration as LaunchConfiguration
    from .launch_log_dir import LaunchLogDir as LaunchLogDir
    from .local_substitution import LocalSubstitution as LocalSubstitution
    from .not_equals_substitution import NotEqualsSubstitution as NotEqualsSubstitution
    from .path_join_substitution import PathJoinSubstitution as PathJoinSubstitution
    from .path_substitution import PathSubstitution as PathSubstitution
    from .python_expression import PythonExpression as PythonExpression
    from .substitution_failure import SubstitutionFailure as SubstitutionFailure
    from .text_substitution import TextSubstitution as TextSubstitution
    from .this_launch_file import ThisLaunchFile as ThisLaunchFile
    from .this_launch_file_dir import ThisLaunchFileDir as ThisLaunchFileDir

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
