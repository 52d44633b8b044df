# SPDX-License-Identifier: Apache-2.0
"""Indices of a floating body in `qpos` and `qvel`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Floating:
    """Slices of `qpos` and `qvel`: linear velocity in world axes, angular in body axes."""

    position: slice
    orientation: slice
    linear: slice
    angular: slice


def floating_body(model: Any, joint: str) -> Floating:
    """
    Find the coordinates of a floating body in `qpos` and `qvel`.

    Parameters
    ----------
    model
        The MuJoCo model.
    joint
        Name of the free joint in it.

    """
    found = model.joint(joint)
    at, rate_at = int(found.qposadr[0]), int(found.dofadr[0])
    return Floating(
        slice(at, at + 3),
        slice(at + 3, at + 7),
        slice(rate_at, rate_at + 3),
        slice(rate_at + 3, rate_at + 6),
    )
