# SPDX-License-Identifier: Apache-2.0
"""
The actions, substitutions and formats of launch files that are not in Python, and how to add some.

Those of launch itself are loaded when a launch file uses them; other packages use `expose_action`
and `expose_substitution`, or entry points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any, TYPE_CHECKING, TypeVar

from ros_environment.entry_points import entry_points_of
from ros_environment.suggestions import did_you_mean

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.substitution import Substitution

ExposedT = TypeVar('ExposedT')
ParseMethod = Callable[..., Any]

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
    'shutdown': 'launch.actions.event_actions:Shutdown',
    'timer': 'launch.actions.timer_action:TimerAction',
    'unset_env': 'launch.actions.environment_variables:UnsetEnvironmentVariable',
}

SUBSTITUTIONS = {
    'all': 'launch.substitutions.logic:AllSubstitution',
    'and': 'launch.substitutions.logic:AndSubstitution',
    'anon': 'launch.substitutions.anon_name:AnonName',
    'any': 'launch.substitutions.logic:AnySubstitution',
    'command': 'launch.substitutions.command:Command',
    'dirname': 'launch.substitutions.this_launch_file:ThisLaunchFileDir',
    'env': 'launch.substitutions.context_values:EnvironmentVariable',
    'equals': 'launch.substitutions.logic:EqualsSubstitution',
    'eval': 'launch.substitutions.python_expression:PythonExpression',
    'file-content': 'launch.substitutions.command:FileContent',
    'filename': 'launch.substitutions.this_launch_file:ThisLaunchFile',
    'find-exec': 'launch.substitutions.command:FindExecutable',
    'if': 'launch.substitutions.logic:IfElseSubstitution',
    'launch_log_dir': 'launch.substitutions.this_launch_file:LaunchLogDir',
    'log_dir': 'launch.substitutions.this_launch_file:LaunchLogDir',
    'not': 'launch.substitutions.logic:NotSubstitution',
    'not-equals': 'launch.substitutions.logic:NotEqualsSubstitution',
    'or': 'launch.substitutions.logic:OrSubstitution',
    'var': 'launch.substitutions.context_values:LaunchConfiguration',
}

PARSERS = {
    'xml': 'launch_xml.parser:Parser',
    'yaml': 'launch_yaml.parser:Parser',
}

# Modules of other packages with such tables.
_MORE = ('launch_ros.frontend_names',)

_TAG_GROUP = 'launch.frontend.launch_extension'
_PARSER_GROUP = 'launch.frontend.parser'

# Names of ROS 1, and of other places, with what ROS 2 has instead.
_OLD_TAGS = {
    'rosparam': 'write <param from="FILE"/> in the node',
    'test': 'tests are Python files, see launch_testing',
    'machine': 'all nodes run on this machine',
    'env': 'write <set_env name="..." value="..."/>',
    'param': 'write <param> in a node, or <set_parameter name="..." value="..."/> for all',
    'remap': 'write <remap> in a node, or <set_remap from="..." to="..."/> for all',
}
_OLD_SUBSTITUTIONS = {
    'optenv': '$(env NAME DEFAULT)',
    'find': '$(find-pkg-share PACKAGE)',
    'arg': '$(var NAME)',
}

action_parse_methods: dict[str, ParseMethod] = {}
substitution_parse_methods: dict[str, ParseMethod] = {}


def expose_action(name: str) -> Callable[[ExposedT], ExposedT]:
    """
    Create a decorator that makes an action available to launch files under a tag.

    Parameters
    ----------
    name
        The tag.

    Returns
    -------
    callable
        Decorator of a class that has `parse`, or of a parsing function. It raises a
        RuntimeError if the tag is taken, or if there is no method to parse with.

    """
    return _expose(name, action_parse_methods, known_actions)


def expose_substitution(name: str) -> Callable[[ExposedT], ExposedT]:
    """
    Create a decorator that makes a substitution available to launch files under a name.

    Parameters
    ----------
    name
        The name.

    Returns
    -------
    callable
        As for `expose_action`.

    """
    return _expose(name, substitution_parse_methods, known_substitutions)


def instantiate_action(entity: Entity, parser: Parser) -> Action:
    """
    Create the action that an element describes.

    Parameters
    ----------
    entity
        The element, all attributes and children of which must be read.
    parser
        The parser of the file.

    Raises
    ------
    RuntimeError
        No action has the tag of the element.
    ValueError
        The element has attributes or children that it cannot have.

    """
    method = _find(entity.type_name, action_parse_methods, known_actions())
    if method is None:
        names = [*known_actions(), *action_parse_methods]
        raise RuntimeError(_unknown_tag(entity.type_name, names))
    action_class, kwargs = method(entity, parser)
    entity.assert_entity_completely_parsed()
    action: Action = action_class(**kwargs)
    return action


def instantiate_substitution(name: str, arguments: Iterable[Any]) -> Substitution:
    """
    Create a substitution by its name in launch files.

    Parameters
    ----------
    name
        The name.
    arguments : Iterable[Any]
        Its arguments, each as a list of substitutions.

    Raises
    ------
    LookupError
        No substitution has the name.

    """
    method = _find(name, substitution_parse_methods, known_substitutions())
    if method is None:
        names = [*known_substitutions(), *substitution_parse_methods]
        raise LookupError(_unknown_substitution(name, names))
    substitution_class, kwargs = method(list(arguments))
    substitution: Substitution = substitution_class(**kwargs)
    return substitution


def _expose(
    name: str,
    exposed: dict[str, ParseMethod],
    known: Callable[[], dict[str, str]],
) -> Callable[[ExposedT], ExposedT]:
    def register(thing: ExposedT) -> ExposedT:
        if name in known() or (name in exposed and exposed[name] != _parse_method(thing)):
            raise RuntimeError(
                f"two parsing methods are exposed under the name '{name}': {thing!r} needs another"
            )
        exposed[name] = _parse_method(thing)
        return thing

    return register


def _parse_method(thing: Any) -> ParseMethod:
    """Return the function itself, or the method `parse` of a class."""
    method = thing.parse if isinstance(thing, type) and hasattr(thing, 'parse') else thing
    if (isinstance(thing, type) and method is thing) or not callable(method):
        raise RuntimeError(f"the exposed {thing!r} is not a function and has no method 'parse'")
    parse_method: ParseMethod = method
    return parse_method


def _find(
    name: str,
    exposed: dict[str, ParseMethod],
    known: dict[str, str],
) -> ParseMethod | None:
    """Find the parse method of a name: built-in, registered, or of an extension."""
    if name in known:
        return _parse_method(load(known[name]))
    if name not in exposed:
        load_extensions()
    return exposed.get(name)


def _unknown_tag(name: str, known: Iterable[str]) -> str:
    """Format the error about a tag that does not exist, with a suggestion."""
    old = f"'{name}' is not a tag of ROS 2: {_OLD_TAGS[name]}." if name in _OLD_TAGS else ''
    text = f'Unrecognized entity of the type: {name}'
    return '\n'.join(filter(None, [text, old or did_you_mean(name, known)]))


def _unknown_substitution(name: str, known: Iterable[str]) -> str:
    """Format the error about a substitution that does not exist, with a suggestion."""
    new = _OLD_SUBSTITUTIONS.get(name)
    old = f"ROS 2 has '{new}'." if new else ''
    text = f'Unknown substitution: {name}'
    return '\n'.join(filter(None, [text, old or did_you_mean(name, known)]))


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
    _load_group(_TAG_GROUP, known=())


@cache
def extension_parsers() -> dict[str, type[Parser]]:
    """Return the parsers of other packages by name."""
    return _load_group(_PARSER_GROUP, known=PARSERS)


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
        f"the extension '{name}' ({value}) of the group '{group}' cannot be loaded and is "
        f'skipped: {type(error).__name__}: {error}',
        stacklevel=2,
    )
