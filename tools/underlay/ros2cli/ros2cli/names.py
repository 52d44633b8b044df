# SPDX-License-Identifier: Apache-2.0
"""
Graph names: as users write them, as they are listed, and as DDS has them.

The names in DDS are those of the design article "Topic and Service name mapping to DDS"
(design.ros2.org).
"""

from __future__ import annotations

from collections.abc import Iterable
import re
from typing import NamedTuple

NAME = re.compile(r'(/[A-Za-z_][A-Za-z0-9_]*)+')
TOPIC, REQUEST, RESPONSE = 'rt', 'rq', 'rr'
"""Prefixes of the names in DDS, by the kind of the DDS topic."""
DDS_SUFFIXES = {TOPIC: '', REQUEST: 'Request', RESPONSE: 'Reply'}
DDS_TYPE = re.compile(r'(?P<namespace>.+)::dds_::(?P<name>.+)_')
PART_OF_SERVICE = re.compile(r'_(Request|Response)$')


def absolute(name: str, kind: str = 'topic') -> str:
    """
    Validate a graph name, and add a missing leading slash.

    Parameters
    ----------
    name
        The name as written by the user.
    kind
        The kind of the name, for the error message.

    Returns
    -------
    str
        The full name.

    Raises
    ------
    RuntimeError
        It is not a valid name.

    """
    full_name = name if name.startswith('/') else f'/{name}'
    if not NAME.fullmatch(full_name):
        raise RuntimeError(
            f"'{name}' is not a valid {kind} name: parts of letters, digits and "
            'underscores, none of which starts with a digit, joined by slashes, as in '
            "'/robot1/joint_commands'"
        )
    return full_name


def closest(name: str, known: Iterable[str]) -> str:
    """
    Return a question that suggests the known name probably meant, or ''.

    Parameters
    ----------
    name
        The name that was not found.
    known
        The existing names.

    """
    from ros_environment.suggestions import did_you_mean

    names = list(known)
    with_slash = f'/{name}'
    return f'Did you mean {with_slash!r}?' if with_slash in names else did_you_mean(name, names)


def is_hidden(name: str) -> bool:
    """
    Whether a part of a name starts with an underscore.

    Parameters
    ----------
    name
        The name of a node, topic or service.

    """
    return any(part.startswith('_') for part in name.split('/'))


def print_names(names: list[str], *, only_count: bool) -> None:
    """
    Print names, one per line, or their count.

    Parameters
    ----------
    names
        The lines.
    only_count
        Whether to print the count.

    """
    for line in [str(len(names))] if only_count else names:
        print(line)


def with_types(names_and_types: Iterable[tuple[str, list[str]]], *, show_types: bool) -> list[str]:
    """
    Format names, optionally with their types in brackets.

    Parameters
    ----------
    names_and_types
        The names and types, as the graph returns them.
    show_types
        Whether to add the types.

    """
    return [
        f'{name} [{", ".join(types)}]' if show_types else name for name, types in names_and_types
    ]


class RosName(NamedTuple):
    """
    The ROS name and kind of a DDS topic.

    :param kind: TOPIC, REQUEST or RESPONSE
    :param name: name of the topic or service
    """

    kind: str
    name: str


def ros_name(topic: str) -> RosName | None:
    """
    Translate the name of a DDS topic to ROS.

    Parameters
    ----------
    topic
        The name in DDS, such as `rt/chatter`.

    Returns
    -------
    RosName or None
        The name and kind in ROS; None if the topic does not come from ROS.

    """
    kind, slash, rest = topic.partition('/')
    suffix = DDS_SUFFIXES.get(kind)
    if suffix is None or not slash or not rest.endswith(suffix):
        return None
    return RosName(kind, f'/{rest.removesuffix(suffix)}')


def ros_type(type_name: str) -> str:
    """
    Translate the name of a DDS type to ROS, as `pkg/msg/Name`.

    Parameters
    ----------
    type_name
        The name in DDS; it is returned as it is if it does not come from ROS.

    """
    match = DDS_TYPE.fullmatch(type_name)
    if not match:
        return type_name
    return f'{match["namespace"].replace("::", "/")}/{match["name"]}'


def service_type(type_name: str) -> str:
    """
    Translate the DDS type of a service's requests or responses to ROS, as `pkg/srv/Name`.

    Parameters
    ----------
    type_name
        The name in DDS.

    """
    return PART_OF_SERVICE.sub('', ros_type(type_name))
