# SPDX-License-Identifier: Apache-2.0
"""A part of the scene that is redrawn repeatedly."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viser import SceneApi

__all__ = ['Canvas']

COLORS = ('colors', 'batched_colors')
ONCE = ('jpeg_quality',)
"""Arguments that can only be set when a node is added."""


@dataclass
class Thing:
    """A node of the scene, with the arguments it was last put with."""

    kind: str
    handle: Any
    look: dict[str, Any]


class Canvas:
    """
    Scene nodes below one path, which are updated in place as they are drawn again.

    A node that is put again under its name is updated, not recreated: a browser shows a new node
    at the origin before it moves to its pose.

    Parameters
    ----------
    scene
        The scene of the viser server.
    root
        The path of the scene below which all nodes are.

    """

    def __init__(self, scene: SceneApi, root: str) -> None:
        self._scene = scene
        self._root = root
        self._things: dict[str, Thing] = {}
        self._seen: set[str] = set()

    @contextmanager
    def anew(self) -> Iterator[None]:
        """Remove all nodes not put again in a `with` block; keep all if the block fails."""
        self._seen = set()
        yield
        for name in [name for name in self._things if name not in self._seen]:
            self._things.pop(name).handle.remove()

    def put(self, kind: str, name: str, **look: Any) -> Any:
        """
        Add a node to the scene, or update the one of this name.

        A node of another kind, or with a different set of arguments, is recreated.

        Parameters
        ----------
        kind
            What to add, as in `scene.add_KIND` of viser, such as `mesh_simple` or `point_cloud`.
        name
            The name of the node, below the root of the canvas.
        **look
            The keyword arguments of `scene.add_KIND`.

        Returns
        -------
        Any
            The handle that viser has for the node.

        """
        self._seen.add(name)
        thing = self._things.get(name)
        if thing is not None and thing.kind == kind and thing.look.keys() == look.keys():
            _change(thing, look)
            return thing.handle
        handle = getattr(self._scene, f'add_{kind}')(f'{self._root}/{name}', **look)
        self._things[name] = Thing(kind, handle, look)
        return handle


def _change(thing: Thing, look: dict[str, Any]) -> None:
    """Set the attributes that have changed; viser itself detects which arrays have changed."""
    for name, value in look.items():
        before = thing.look[name]
        is_array = isinstance(value, np.ndarray) or isinstance(before, np.ndarray)
        if name in ONCE or (not is_array and value == before):
            continue
        colors = np.asarray(value, dtype=np.uint8) if name in COLORS else value
        setattr(thing.handle, name, colors)
    thing.look = look
