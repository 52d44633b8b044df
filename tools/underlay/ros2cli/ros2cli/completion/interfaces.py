# SPDX-License-Identifier: Apache-2.0
"""Complete the types of messages, services and actions."""

from __future__ import annotations

import argparse

from ament_index_python.resources import get_resource, get_resources
from ros2cli.completion.graph import types_of_service, types_of_topic

RESOURCE = 'rosidl_interfaces'


def packages(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the packages that define interfaces."""
    return sorted(get_resources(RESOURCE))


def interfaces(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return all types; only the packages as long as none is named, since there are hundreds."""
    return _packages_first(prefix, ('msg', 'srv', 'action'))


def messages(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the types of messages."""
    return _packages_first(prefix, ('msg',))


def actions(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the types of actions."""
    return _packages_first(prefix, ('action',))


def messages_of_topic(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the types of a topic, or those of all messages if nobody uses it yet."""
    return types_of_topic(args.topic_name) or messages(prefix, args)


def services_of_name(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the types of a service, or those of all services if it is not named."""
    name = getattr(args, 'service_name', None)
    return (types_of_service(name) if name else []) or _packages_first(prefix, ('srv',))


def _packages_first(prefix: str, kinds: tuple[str, ...]) -> list[str]:
    package, slash, _ = prefix.partition('/')
    names = [package] if slash else packages(prefix, argparse.Namespace())
    found = {
        name: types for name in names if name.startswith(package) if (types := _types(name, kinds))
    }
    if len(found) > 1:
        return [f'{name}/' for name in found]
    return [text for types in found.values() for text in types]


def _types(package: str, kinds: tuple[str, ...]) -> list[str]:
    if package not in get_resources(RESOURCE):
        return []
    lines, _ = get_resource(RESOURCE, package)
    names = {line.rpartition('.')[0] for line in lines.splitlines()}
    return sorted(f'{package}/{name}' for name in names if name.partition('/')[0] in kinds)
