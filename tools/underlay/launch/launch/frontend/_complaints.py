# SPDX-License-Identifier: Apache-2.0
"""Error messages about elements of launch files."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TYPE_CHECKING

from launch._did_you_mean import did_you_mean

if TYPE_CHECKING:
    from launch.frontend.entity import Entity

_TAGS = {
    'rosparam': 'write <param from="FILE"/> in the node',
    'test': 'tests are Python files, see launch_testing',
    'machine': 'all nodes run on this machine',
    'env': 'write <set_env name="..." value="..."/>',
    'param': 'write <param> in a node, or <set_parameter name="..." value="..."/> for all',
    'remap': 'write <remap> in a node, or <set_remap from="..." to="..."/> for all',
}
_SUBSTITUTIONS = {
    'optenv': '$(env NAME DEFAULT)',
    'find': '$(find-pkg-share PACKAGE)',
    'arg': '$(var NAME)',
}
_ATTRIBUTES = {
    ('node', 'type'): "write 'exec'",
    ('node', 'package'): "XML and YAML write 'pkg'",
    ('node', 'executable'): "XML and YAML write 'exec'",
    ('composable_node', 'package'): "XML and YAML write 'pkg'",
    ('node', 'required'): 'write on_exit="shutdown"',
    ('node', 'ns'): "write 'namespace'",
    ('node', 'launch_prefix'): "write 'launch-prefix'",
    ('executable', 'launch_prefix'): "write 'launch-prefix'",
    ('group', 'ns'): 'write <push_ros_namespace namespace="..."/> in it',
    ('include', 'ns'): 'put it in a group with <push_ros_namespace namespace="..."/>',
    ('include', 'pass_all_args'): 'an included file sees all variables anyway',
    ('arg', 'value'): 'write <let name="..." value="..."/>, or \'default\'',
    ('arg', 'doc'): "write 'description'",
}


def missing_attribute(entity: Entity, name: str, data_type: Any, left: list[str]) -> str:
    """
    Format the error about a missing attribute, with suggestions.

    Parameters
    ----------
    entity
        The element.
    name, data_type
        The attribute that was asked for, and its type.
    left
        The names of attributes and children that have not been read.

    """
    text = f"Attribute '{name}' of type '{data_type}' not found in Entity '{entity.type_name}'"
    return _with_advice(text, [_legacy(entity, each) or _instead(each, name) for each in left])


def unexpected_names(entity: Entity, kind: str, names: list[str], known: list[str]) -> str:
    """
    Format the error about attributes or children that an element cannot have.

    Parameters
    ----------
    entity
        The element.
    kind
        Their kind: `attribute(s)` or `nested tag(s)`.
    names
        Their names.
    known
        The names that the element can have, for suggestions.

    """
    listed = ', '.join(f"'{name}'" for name in sorted(set(names)))
    text = f'Unexpected {kind} found in `{entity.type_name}`: {{{listed}}}'
    return _with_advice(text, [_legacy(entity, each) or _meant(each, known) for each in names])


def wrong_value(entity: Entity, name: str, error: Exception) -> str:
    """
    Format the error about an attribute whose value cannot be used.

    Parameters
    ----------
    entity, name
        The element, and the attribute.
    error
        The error about the value.

    """
    return f"The attribute '{name}' of `{entity.type_name}` cannot be used: {error}"


def unknown_tag(name: str, known: Iterable[str]) -> str:
    """
    Format the error about a tag that does not exist, with suggestions.

    Parameters
    ----------
    name
        The tag.
    known
        The known tags.

    """
    old = f"'{name}' is none of the tags of ROS 2: {_TAGS[name]}." if name in _TAGS else ''
    text = f'Unrecognized entity of the type: {name}'
    return _with_advice(text, [old or did_you_mean(name, known)])


def unknown_substitution(name: str, known: Iterable[str]) -> str:
    """
    Format the error about a substitution that does not exist, with suggestions.

    Parameters
    ----------
    name
        The name of the substitution.
    known
        The known names.

    """
    new = _SUBSTITUTIONS.get(name)
    old = f"ROS 2 writes '{new}'." if new else ''
    return _with_advice(f'Unknown substitution: {name}', [old or did_you_mean(name, known)])


def _meant(name: str, known: list[str]) -> str:
    return did_you_mean(name, [each for each in known if each != name])


def _instead(given: str, missing: str) -> str:
    close = did_you_mean(given, [missing])
    return f"There is '{given}' instead: was '{missing}' meant?" if close else ''


def _legacy(entity: Entity, name: str) -> str:
    advice = _ATTRIBUTES.get((entity.type_name, name))
    return f"ROS 2 has no '{name}' there: {advice}." if advice else ''


def _with_advice(text: str, advice: Iterable[str]) -> str:
    return '\n'.join([text, *filter(None, advice)])
