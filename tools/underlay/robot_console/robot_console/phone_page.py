# SPDX-License-Identifier: Apache-2.0
"""The page for phones: the scene above, the stop button, the stick and the robot's state below."""

from __future__ import annotations

from typing import Any
from weakref import WeakKeyDictionary

from robot_console.page_text import page_text, path_of
from rviz_common.page import Page, Route

__all__ = ['join', 'leave']

NEEDED = ('safety', 'drive')
PARTS = (*NEEDED, 'robot')

_PARTS: WeakKeyDictionary[Page, dict[str, dict[str, Any]]] = WeakKeyDictionary()
"""The settings of the parts that each page has, by namespace and name."""


def join(page: Page, name: str, namespace: str, settings: dict[str, Any]) -> None:
    """
    Make an embedded page a part of the page for phones, which has the stick and the stop button.

    A robot has one as soon as it has both. Browsers with a small screen are led to that of the
    first such robot.

    Parameters
    ----------
    page
        The page that serves it.
    name, namespace, settings
        As for `SmallPage`; pages of other names are no parts.

    """
    if name in PARTS:
        _PARTS.setdefault(page, {}).setdefault(namespace, {})[name] = settings
        _offer(page, namespace)


def leave(page: Page, name: str, namespace: str) -> None:
    """
    Remove an embedded page from the page for phones.

    Parameters
    ----------
    page, name, namespace
        As for `join`.

    """
    if name in PARTS:
        _PARTS[page][namespace].pop(name)
        _offer(page, namespace)


def _offer(page: Page, namespace: str) -> None:
    """Serve the page for phones of a robot, or serve it no longer, and lead browsers there."""
    path = path_of('phone', namespace)
    parts = _PARTS[page][namespace]
    page.routes.remove(path)
    if _is_complete(parts):
        paths = {name: path_of(name, namespace) for name in parts}
        page.routes.add(path, Route(page_text('phone', {**parts, 'paths': paths})))
    robots = [each for each, parts in _PARTS[page].items() if _is_complete(parts)]
    page.lead_small_screens(path_of('phone', robots[0]) if robots else '')


def _is_complete(parts: dict[str, Any]) -> bool:
    return all(name in parts for name in NEEDED)
