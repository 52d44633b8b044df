# SPDX-License-Identifier: Apache-2.0
"""The substitutions: text that is known only when the launch runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import SubstitutionFailure, TextSubstitution
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.substitutions.anon_name import AnonName
    from launch.substitutions.command import Command, FileContent, FindExecutable
    from launch.substitutions.context_values import (
        EnvironmentVariable,
        LaunchConfiguration,
        LocalSubstitution,
    )
    from launch.substitutions.logic import (
        AllSubstitution,
        AndSubstitution,
        AnySubstitution,
        EqualsSubstitution,
        IfElseSubstitution,
        NotEqualsSubstitution,
        NotSubstitution,
        OrSubstitution,
    )
    from launch.substitutions.path_join_substitution import PathJoinSubstitution, PathSubstitution
    from launch.substitutions.python_expression import PythonExpression
    from launch.substitutions.this_launch_file import (
        LaunchLogDir,
        ThisLaunchFile,
        ThisLaunchFileDir,
    )

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

# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'boolean_substitution',
    'environment_variable',
    'equals_substitution',
    'file_content',
    'find_executable',
    'if_else_substitution',
    'launch_configuration',
    'launch_log_dir',
    'local_substitution',
    'not_equals_substitution',
    'path_substitution',
    'substitution_failure',
    'text_substitution',
    'this_launch_file_dir',
)

_ELSEWHERE = {
    'AllSubstitution': 'logic',
    'AndSubstitution': 'logic',
    'AnySubstitution': 'logic',
    'EnvironmentVariable': 'context_values',
    'EqualsSubstitution': 'logic',
    'FileContent': 'command',
    'FindExecutable': 'command',
    'IfElseSubstitution': 'logic',
    'LaunchConfiguration': 'context_values',
    'LaunchLogDir': 'this_launch_file',
    'LocalSubstitution': 'context_values',
    'NotEqualsSubstitution': 'logic',
    'NotSubstitution': 'logic',
    'OrSubstitution': 'logic',
    'PathSubstitution': 'path_join_substitution',
    'ThisLaunchFileDir': 'this_launch_file',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
