# SPDX-License-Identifier: Apache-2.0
"""
Locations of the tags, substitutions and parsers of launch files.

Those of launch itself are loaded when a launch file uses them; other packages use
`launch.frontend.expose` or entry points.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any, TYPE_CHECKING

from ros_environment.entry_points import entry_points_of

if TYPE_CHECKING:
    from launch.frontend.parser import Parser

ACTIONS = {
    'append_env': 'launch.actions.environment_variables:AppendEnvironmentVariable',
    'arg': 'launch.actions.declare_launch_argument:DeclareLaunchArgument',
    'executable': 'launch.actions.execute_process:ExecuteProcess',
    'group': 'launch.actions.group_action:GroupAction',
    'include': 'launch.actions.include_launch_description:IncludeLaunchDescription',
    'let': 'launch.actions.launch_configurations:SetLaunchConfiguration',
    'log': 'launch.actions.log_info:LogInfo',
    'reset': 'launch.actions.launch_configurations:ResetLaunchConfigurations',
    'reset_env': 'launch.actions:ResetEnvironment',
    'set_env': 'launch.actions.environment_variables:SetEnvironmentVariable',
    'shutdown': 'launch.actions.shutdown_action:Shutdown',
    'timer': 'launch.actions.timer_action:TimerAction',
    'unset_env': 'launch.actions.environment_variables:UnsetEnvironmentVariable',
}

SUBSTITUTIONS = {
    'all': 'launch.substitutions.boolean_substitution:AllSubstitution',
    'and': 'launch.substitutions.boolean_substitution:AndSubstitution',
    'anon': 'launch.substitutions.anon_name:AnonName',
    'any': 'launch.substitutions.boolean_substitution:AnySubstitution',
    'command': 'launch.substitutions.command:Command',
    'dirname': 'launch.substitutions.this_launch_file:ThisLaunchFileDir',
    'env': 'launch.substitutions.environment_variable:EnvironmentVariable',
    'equals': 'launch.substitutions.equals_substitution:EqualsSubstitution',
    'eval': 'launch.substitutions.python_expression:PythonExpression',
    'file-content': 'launch.substitutions.file_content:FileContent',
    'filename': 'launch.substitutions.this_launch_file:ThisLaunchFile',
    'find-exec': 'launch.substitutions.find_executable:FindExecutable',
    'if': 'launch.substitutions.if_else_substitution:IfElseSubstitution',
    'launch_log_dir': 'launch.substitutions.launch_log_dir:LaunchLogDir',
    'log_dir': 'launch.substitutions.launch_log_dir:LaunchLogDir',
    'not': 'launch.substitutions.boolean_substitution:NotSubstitution',
    'not-equals': 'launch.substitutions.equals_substitution:NotEqualsSubstitution',
    'or': 'launch.substitutions.boolean_substitution:OrSubstitution',
    'var': 'launch.substitutions.launch_configuration:LaunchConfiguration',
}

PARSERS = {
    'xml': 'launch_xml.parser:Parser',
    'yaml': 'launch_yaml.parser:Parser',
}

# Modules of other packages with such tables.
_MORE = ('launch_ros._known_names',)

_TAGS = 'launch.frontend.launch_extension'
_PARSERS = 'launch.frontend.parser'


@cache
def known_actions() -> dict[str, str]:
    """Return the location of the action of each tag."""
    return _together('ACTIONS', ACTIONS)


@cache
def known_substitutions() -> dict[str, str]:
    """Return the location of each substitution."""
    return _together('SUBSTITUTIONS', SUBSTITUTIONS)


def load(place: str) -> type:
    """
    Import the class at a location.

    Parameters
    ----------
    place
        The module and the name of the class, with a colon between them.

    """
    module, _, name = place.partition(':')
    found: type = getattr(import_module(module), name)
    return found


def _together(table: str, own: dict[str, str]) -> dict[str, str]:
    places = dict(own)
    for module in _MORE:
        if find_spec(module.partition('.')[0]) is not None:
            places.update(getattr(import_module(module), table))
    return places


@cache
def load_extensions() -> None:
    """Import the modules that expose tags and substitutions."""
    _load_group(_TAGS, known=())


@cache
def extension_parsers() -> dict[str, type[Parser]]:
    """Return the parsers of other packages by name."""
    return _load_group(_PARSERS, known=PARSERS)


def _load_group(group: str, known: Any) -> dict[str, Any]:
    """Load all entry points of a group; warn about those that cannot be loaded."""
    loaded = {}
    for point in entry_points_of(group):
        if point.name in known:
            continue
        try:
            loaded[point.name] = point.load()
        except Exception as error:
            _warn(group, point.name, point.value, error)
    return loaded


def _warn(group: str, name: str, value: str, error: Exception) -> None:
    import warnings

    warnings.warn(
        f"the extension '{name}' ({value}) of the group '{group}' cannot be loaded and is left "
        f'out: {type(error).__name__}: {error}',
        stacklevel=2,
    )
