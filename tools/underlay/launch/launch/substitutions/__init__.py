# SPDX-License-Identifier: Apache-2.0
"""The substitutions: text that is known only when the launch runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import SubstitutionFailure
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.substitutions.anon_name import AnonName
    from launch.substitutions.boolean_substitution import (
        AllSubstitution,
        AndSubstitution,
        AnySubstitution,
        NotSubstitution,
        OrSubstitution,
    )
    from launch.substitutions.command import Command
    from launch.substitutions.environment_variable import EnvironmentVariable
    from launch.substitutions.equals_substitution import EqualsSubstitution, NotEqualsSubstitution
    from launch.substitutions.file_content import FileContent
    from launch.substitutions.find_executable import FindExecutable
    from launch.substitutions.if_else_substitution import IfElseSubstitution
    from launch.substitutions.launch_configuration import LaunchConfiguration
    from launch.substitutions.launch_log_dir import LaunchLogDir
    from launch.substitutions.local_substitution import LocalSubstitution
    from launch.substitutions.path_join_substitution import PathJoinSubstitution, PathSubstitution
    from launch.substitutions.python_expression import PythonExpression
    from launch.substitutions.text_substitution import TextSubstitution
    from launch.substitutions.this_launch_file import ThisLaunchFile, ThisLaunchFileDir

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
    'not_equals_substitution',
    'path_substitution',
    'substitution_failure',
    'this_launch_file_dir',
)

_ELSEWHERE = {
    'AllSubstitution': 'boolean_substitution',
    'AndSubstitution': 'boolean_substitution',
    'AnySubstitution': 'boolean_substitution',
    'NotEqualsSubstitution': 'equals_substitution',
    'NotSubstitution': 'boolean_substitution',
    'OrSubstitution': 'boolean_substitution',
    'PathSubstitution': 'path_join_substitution',
    'ThisLaunchFileDir': 'this_launch_file',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
