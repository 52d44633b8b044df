# SPDX-License-Identifier: Apache-2.0
"""The services of the graph."""

from __future__ import annotations

from typing import Any

from ros2cli.names import closest, is_hidden

__all__ = [
    'get_service_names_and_types',
    'get_service_types',
    'service_hint',
    'unknown_service_text',
]


def get_service_names_and_types(
    *,
    node: Any,
    include_hidden_services: bool = False,
) -> list[tuple[str, list[str]]]:
    """Return the services that others offer or call, sorted, with their types."""
    return sorted(
        (name, types)
        for name, types in node.get_service_names_and_types()
        if include_hidden_services or not is_hidden(name)
    )


def get_service_types(node: Any, service: str) -> list[str]:
    """Return the types of one service, hidden or not; none if nobody uses it."""
    found = get_service_names_and_types(node=node, include_hidden_services=True)
    return dict(found).get(service, [])


def unknown_service_text(node: Any, service: str) -> str:
    """Return the error text for an unknown service, with a name that comes close."""
    hint = closest(service, _offered(node))
    return '\n'.join([f"Unknown service '{service}'", hint]).rstrip()


def service_hint(node: Any, service: str, type_name: str) -> str:
    """Return why a service may not answer: it has another name or another type, or ''."""
    others = [name for name in get_service_types(node, service) if name != type_name]
    if others and node.count_services(service):
        return f"'{service}' has the type '{others[0]}', not '{type_name}'."
    return closest(service, [name for name in _offered(node) if name != service])


def _offered(node: Any) -> list[str]:
    names = [name for name, _ in get_service_names_and_types(node=node)]
    return [name for name in names if node.count_services(name)]
